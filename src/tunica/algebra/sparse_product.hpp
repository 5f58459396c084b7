#pragma once
#include "tunica/base/types.hpp"

namespace tunica::algebra {

/// A copy with ones for all entries of the graph: nothing cancels in its products.
CrsMatrix with_ones(const CrsMatrix& A);

/// A B, and again for new values of both on the same graphs. Entries of the graphs that are zero
/// count as any others: Tpetra itself leaves the products of zeros out of its graph.
class SparseProduct {
public:
  /// The graph alone: values come with refresh(). The matrices must outlive the object. Collective.
  SparseProduct(const CrsMatrix& A, const CrsMatrix& B);

  const Teuchos::RCP<CrsMatrix>& matrix() const { return product_; }
  /// Numeric work only. Collective.
  void refresh();

private:
  const CrsMatrix *A_, *B_;
  Teuchos::RCP<CrsMatrix> product_;
};

}  // namespace tunica::algebra
