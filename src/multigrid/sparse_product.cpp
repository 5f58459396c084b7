#include "multigrid/sparse_product.hpp"

#include <TpetraExt_MatrixMatrix.hpp>

namespace tunica::multigrid {

namespace {

CrsMatrix ones_like(const CrsMatrix& A) {
  CrsMatrix ones(A, Teuchos::Copy);
  ones.resumeFill();
  ones.setAllToScalar(1.0);
  ones.fillComplete(A.getDomainMap(), A.getRangeMap());
  return ones;
}

}  // namespace

SparseProduct::SparseProduct(const CrsMatrix& A, const CrsMatrix& B)
    : A_(&A), B_(&B), product_(Teuchos::rcp(new CrsMatrix(A.getRowMap(), 0))) {
  const CrsMatrix ones_A = ones_like(A), ones_B = ones_like(B);
  Tpetra::MatrixMatrix::Multiply(ones_A, false, ones_B, false, *product_);
  refresh();
}

void SparseProduct::refresh() {
  // Finds the graph there and fills in values only.
  Tpetra::MatrixMatrix::Multiply(*A_, false, *B_, false, *product_);
}

}  // namespace tunica::multigrid
