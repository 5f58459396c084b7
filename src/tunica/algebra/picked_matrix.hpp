#pragma once
#include <vector>

#include "tunica/base/types.hpp"

namespace tunica::algebra {

/// Some rows and columns of a matrix, R K Cᵀ, under their numbers there.
class PickedMatrix {
public:
  /// Flags of the rows of K and of its domain: 0 for those that are left out. Collective.
  PickedMatrix(const CrsMatrix& K, const Vector& rows, const Vector& columns);

  const Teuchos::RCP<CrsMatrix>& matrix() const { return matrix_; }
  /// Takes over values of K, or of any matrix on its graph.
  void refresh(const CrsMatrix& K);

private:
  Teuchos::RCP<CrsMatrix> matrix_;
  std::vector<std::size_t> offsets_;  ///< where each value stands in K
};

/// These rows and columns of a graph. Collective.
Teuchos::RCP<CrsGraph> picked_graph(const CrsGraph& G, const Vector& rows, const Vector& columns);

/// Local rows with a flag that is not zero, and the map of their numbers (collective).
std::vector<int> flagged_rows(const Vector& flags);
Teuchos::RCP<const Map> flagged_map(const Vector& flags);

/// A square matrix with numbers without gaps, ascending with the ranks, as some packages want them.
/// Rows keep their order on each rank. Shares the values. Collective.
Teuchos::RCP<CrsMatrix> renumbered(const CrsMatrix& A);

/// The values of these rows, x_s = R x, and x ← x + ω Rᵀ x_s, of all columns.
void pick_rows(const std::vector<int>& rows, const MultiVector& x, MultiVector& picked);
void add_rows(const std::vector<int>& rows, double factor, const MultiVector& picked,
              MultiVector& x);

}  // namespace tunica::algebra
