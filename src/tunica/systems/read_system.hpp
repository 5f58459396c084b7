#pragma once
#include <algorithm>
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
  int field;                           ///< 0: vectors, 1: scalars
  int component;                       ///< of the vectors
  Teuchos::RCP<const Vector> left{};   ///< n with nᵀ K = 0, if there is one
  Teuchos::RCP<const Vector> right{};  ///< n with K n = 0
  GlobalOrdinal held = -1;             ///< the unknown whose diagonal makes K regular
  std::vector<double> in_rows{};       ///< C n for each row C of the border; 0 for rounding
  std::vector<double> in_columns{};    ///< nᵀ B for each column B, of the left n
  std::string note{};

  bool is_given_by_border() const { return has_any(in_rows); }
  bool is_taken_by_border() const { return has_any(in_columns); }
  static bool has_any(const std::vector<double>& numbers) {
    return std::any_of(numbers.begin(), numbers.end(), [](double x) { return x != 0.0; });
  }
};

/// A system K x = b of another program.
struct System {
  algebra::BlockMatrix K;      ///< as it is solved with, see Preparation
  algebra::BlockMatrix given;  ///< as it is in the files, but for signs of whole fields
  /// The scalars that border K, whose rows and columns in it are those of the unit matrix: their
  /// numbers, ascending, on all ranks.
  std::vector<GlobalOrdinal> border{};
  /// What the user knows to be like C + B2 A⁻¹ B1ᵀ, in the rows and columns of K; null: nothing.
  Teuchos::RCP<const CrsMatrix> schur{};
  /// Of the right-hand side that was taken last: R b', known values x_k, and itself with the signs
  /// of what is given.
  algebra::BlockVector b, known, given_b;
  std::vector<std::string> remarks{};  ///< what is doubtful in the files; on rank 0
  std::vector<std::string> notes{};    ///< what was found and is taken care of; on rank 0
  std::string order;                   ///< of the unknowns, in words
  Teuchos::ParameterList found{};      ///< values of keys that are automatic

  /// See Preparation.
  algebra::BlockVector known_in, row_scale, scale;
  int rounds = 0;
  bool is_searched_for_constants = false;
  std::vector<ConstantMode> constants{};  ///< that K does not determine
  std::array<double, 2> signs{1.0, 1.0};  ///< factors of the rows of each field

  /// Rows of the files of a right-hand side that belong to the unknowns of each field.
  std::array<Teuchos::RCP<const Map>, 2> file_rows{};
  /// How messages name them: the files, and the rows that count as their first ones.
  std::array<std::string, 2> files{};
  std::array<long long, 2> first_row{};
};

/// The keys of a "System" list: files in the Matrix Market format with the blocks and the
/// right-hand side, and how unknowns belong to nodes.
params::Table system_table();
/// Of these the keys that say what a matrix is, not where it is.
void add_matrix_keys(params::Table& table);

/// Reads the files on rank 0, some lines at once, and deals the nodes to all ranks; none has more
/// than its portion of what is read and its share of K. Throws tunica::Error on all ranks for a
/// file that cannot be read or whose size does not fit the others. Collective.
System read_system(const Teuchos::ParameterList& options, const CommPtr& comm,
                   std::size_t lines_at_once = entries_at_once);

/// x in the units of the files for a solution of the system: x = x_k + C y, constants that K does
/// not determine so that the mean is zero. Collective.
algebra::BlockVector in_units_of_files(const System& system, const algebra::BlockVector& y);

/// A vector of the system with its rows in the order of the files, those of A, then those of B2, or
/// those of K: all on rank 0, or on the ranks of a map of them. Collective.
Vector in_file_order(const System& system, const algebra::BlockVector& x);
Vector in_file_order(const System& system, const algebra::BlockVector& x,
                     const Teuchos::RCP<const Map>& rows);

}  // namespace tunica::systems
