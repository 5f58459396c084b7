#include "tunica/algebra/products/sparse_product.hpp"

#include <TpetraExt_MatrixMatrix.hpp>
#include <vector>

#include "tunica/base/trilinos.hpp"

namespace tunica::algebra {

namespace {

/// Ones in place of the zeros of a matrix, as long as it lives.
class WithoutZeros {
public:
  explicit WithoutZeros(const CrsMatrix& A) : A_(&A) {
    const auto values = A.getLocalMatrixHost().values;
    for (std::size_t k = 0; k < values.extent(0); ++k) {
      if (values(k) != 0.0) continue;
      zeros_.push_back(k);
      values(k) = 1.0;
    }
  }
  ~WithoutZeros() {
    const auto values = A_->getLocalMatrixHost().values;
    for (const std::size_t k : zeros_) values(k) = 0.0;
  }
  WithoutZeros(const WithoutZeros&) = delete;
  WithoutZeros& operator=(const WithoutZeros&) = delete;

private:
  const CrsMatrix* A_;
  std::vector<std::size_t> zeros_;
};

}  // namespace

void multiply_graphs(const CrsMatrix& A, const CrsMatrix& B, CrsMatrix& product) {
  const WithoutZeros left(A), right(B);
  Tpetra::MatrixMatrix::Multiply(A, false, B, false, product);
}

SparseProduct::SparseProduct(const CrsMatrix& A, const CrsMatrix& B)
    : A_(&A), B_(&B), product_(Teuchos::rcp(new CrsMatrix(A.getRowMap(), 0))) {
  multiply_graphs(A, B, *product_);
}

void SparseProduct::refresh() {
  // Finds the graph there and fills in values only.
  Tpetra::MatrixMatrix::Multiply(*A_, false, *B_, false, *product_);
}

}  // namespace tunica::algebra
