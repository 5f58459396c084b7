#pragma once
#include <Teuchos_ParameterList.hpp>
#include <string>
#include <vector>

#include "tunica/systems/matrix_rows.hpp"

namespace tunica::systems {

/// Which rows of one matrix with all unknowns are those of scalars (pressures, multipliers).
struct ScalarRows {
  std::vector<char> is_scalar;  ///< of every row of the file, on all ranks
  /// Factors that make the diagonal of A positive and that of −C negative.
  double vector_sign = 1.0, scalar_sign = 1.0;
  std::string text;  ///< "scalars last", "no scalars"
  /// Components of the vectors that stand with the scalar of their node, at the same place in each
  /// node; 0: it is another order.
  int in_nodes = 0;
};

/// From the key "scalars", or from K, whose saddle-point form shows in its signs:
///
///   [A B; Bᵀ −C]   diagonals of scalars are zero or of the other sign than those of A
///   [A B; −Bᵀ C]   K_ij K_ji < 0 between vectors and scalars, and > 0 among vectors and among
///                  scalars, for a regular order: first, last, or in each node
///
/// Rows that hold only their diagonal may be of either kind, and go with their neighbours in the
/// file; between vectors and scalars so that the vectors fall into equal components. The key
/// "scalar unknowns" says how many there are. Few vectors whose diagonal convection turned are told
/// by their place. Collective.
ScalarRows find_scalars(const MatrixRows& K, const Teuchos::ParameterList& options);

}  // namespace tunica::systems
