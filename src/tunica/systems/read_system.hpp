#pragma once
#include <array>
#include <string>
#include <vector>

#include "tunica/algebra/block_matrix.hpp"
#include "tunica/params/table.hpp"
#include "tunica/systems/matrix_rows.hpp"

namespace tunica::systems {

/// Unknowns that K does not determine but for a common constant: the scalars, as the pressure of an
/// enclosed flow, or the vectors of a component.
struct ConstantMode {
  int field;      ///< 0: vectors, 1: scalars
  int component;  ///< of the vectors
};

/// A system K x = b of another program.
struct System {
  algebra::BlockMatrix K;  ///< and b: as they are solved, see Preparation
  algebra::BlockVector b;
  std::vector<std::string> remarks{};  ///< what is doubtful in the files; on rank 0
  std::vector<std::string> notes{};    ///< what was found and is taken care of; on rank 0
  algebra::BlockSpacePtr file_space;   ///< equal portions of the rows of the files
  /// The way back to x of the files: known values, 1 where there is one, and the factors of others.
  algebra::BlockVector known, is_known, scale;
  std::vector<ConstantMode> constants{};  ///< that K does not determine
  std::string order;                      ///< of the unknowns, in words
  Teuchos::ParameterList found{};         ///< values of keys that are automatic
  /// Rows of one matrix K that the unknowns of the portions have; empty for blocks.
  std::array<std::vector<long long>, 2> file_rows{};
};

/// The keys of a "System" list: files in the Matrix Market format with the blocks and the
/// right-hand side, and how unknowns belong to nodes.
params::Table system_table();

/// Reads the files on rank 0, some lines at once, and deals the nodes to all ranks; none has more
/// than its portion of what is read and its share of K. Throws tunica::Error on all ranks for a
/// file that cannot be read or whose size does not fit the others. Collective.
System read_system(const Teuchos::ParameterList& options, const CommPtr& comm,
                   std::size_t lines_at_once = entries_at_once);

/// x of the files for a solution of the system: x = x_k + C y, constants that K does not determine
/// so that the mean is zero. Collective.
algebra::BlockVector in_units_of_files(const System& system, const algebra::BlockVector& y);

/// A vector of the system with all its rows on rank 0 in the order of the files: those of A, then
/// those of B2, or those of K. Collective.
Vector in_file_order(const System& system, const algebra::BlockVector& x);

}  // namespace tunica::systems
