#pragma once
#include "tunica/base/types.hpp"

namespace tunica::algebra {

/// product: has no entries; gets all that the graphs of A and B make, whatever values they have at
/// present. Zeros of both are other numbers so long. Collective.
void multiply_graphs(const CrsMatrix& A, const CrsMatrix& B, CrsMatrix& product);

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
