#include "tunica/algebra/sparse_product.hpp"

#include <TpetraExt_MatrixMatrix.hpp>

namespace tunica::algebra {

CrsMatrix with_ones(const CrsMatrix& A) {
  CrsMatrix ones(A, Teuchos::Copy);
  ones.resumeFill();
  ones.setAllToScalar(1.0);
  ones.fillComplete(A.getDomainMap(), A.getRangeMap());
  return ones;
}

SparseProduct::SparseProduct(const CrsMatrix& A, const CrsMatrix& B)
    : A_(&A), B_(&B), product_(Teuchos::rcp(new CrsMatrix(A.getRowMap(), 0))) {
  const CrsMatrix ones_A = with_ones(A), ones_B = with_ones(B);
  Tpetra::MatrixMatrix::Multiply(ones_A, false, ones_B, false, *product_);
}

void SparseProduct::refresh() {
  // Finds the graph there and fills in values only.
  Tpetra::MatrixMatrix::Multiply(*A_, false, *B_, false, *product_);
}

}  // namespace tunica::algebra
