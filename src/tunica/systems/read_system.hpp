#pragma once
#include "tunica/algebra/block_matrix.hpp"
#include "tunica/params/table.hpp"
#include "tunica/systems/matrix_rows.hpp"

namespace tunica::systems {

/// A block system K x = b of another program.
struct System {
  algebra::BlockMatrix K;
  algebra::BlockVector b;
  std::vector<std::string> remarks{};  ///< what is doubtful in the files; on rank 0
  algebra::BlockSpacePtr file_space;   ///< equal portions of the rows of the files
};

/// The keys of a "System" list: files in the Matrix Market format with the blocks and the
/// right-hand side, and how unknowns belong to nodes.
params::Table system_table();

/// Reads the files on rank 0, some lines at once, and deals the nodes to all ranks; none has more
/// than its portion of what is read and its share of K. Throws tunica::Error on all ranks for a
/// file that cannot be read or whose size does not fit the others. Collective.
System read_system(const Teuchos::ParameterList& options, const CommPtr& comm,
                   std::size_t lines_at_once = entries_at_once);

/// A vector of the system with all its rows on rank 0 in the order of the files. Collective.
algebra::BlockVector in_file_order(const System& system, const algebra::BlockVector& x);

}  // namespace tunica::systems
