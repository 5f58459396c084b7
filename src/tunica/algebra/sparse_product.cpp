#include "tunica/algebra/sparse_product.hpp"

#include <TpetraExt_MatrixMatrix.hpp>
#include <TpetraExt_TripleMatrixMultiply.hpp>
#include <algorithm>
#include <numeric>
#include <stdexcept>
#include <utility>
#include <vector>

#include "tunica/algebra/static_matrix.hpp"
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

namespace {

/// The rows of Pᵀ, whatever the values.
struct TransposedGraph {
  std::vector<std::size_t> start;
  std::vector<int> columns;

  explicit TransposedGraph(const CrsMatrix& P) {
    const auto graph = P.getLocalMatrixHost().graph;
    const int n_rows = static_cast<int>(graph.row_map.extent(0)) - 1;
    start.assign(n_local(*P.getColMap()) + 1, 0);
    for (std::size_t k = 0; k < graph.entries.extent(0); ++k) ++start[graph.entries(k) + 1];
    std::partial_sum(start.begin(), start.end(), start.begin());
    std::vector<std::size_t> next(start.begin(), start.end() - 1);
    columns.resize(graph.entries.extent(0));
    for (int i = 0; i < n_rows; ++i)
      for (auto k = graph.row_map(i); k < graph.row_map(i + 1); ++k)
        columns[next[graph.entries(k)]++] = i;
  }
};

/// That of Pᵀ A P, on one rank. Tpetra's own takes room for three times its values while it
/// looks for it.
Teuchos::RCP<CrsGraph> triple_graph(const CrsMatrix& A, const CrsMatrix& P) {
  const auto of_A = A.getLocalMatrixHost().graph, of_P = P.getLocalMatrixHost().graph;
  const TransposedGraph Pt(P);
  const int n_coarse = static_cast<int>(Pt.start.size()) - 1;
  RowStart row_start("row start", n_coarse + 1);
  std::vector<int> found, met(n_coarse, -1);  // met: the last row that has the column
  for (int i = 0; i < n_coarse; ++i) {
    for (std::size_t k = Pt.start[i]; k < Pt.start[i + 1]; ++k)
      for (auto l = of_A.row_map(Pt.columns[k]); l < of_A.row_map(Pt.columns[k] + 1); ++l)
        for (auto j = of_P.row_map(of_A.entries(l)); j < of_P.row_map(of_A.entries(l) + 1); ++j)
          if (const int column = of_P.entries(j); std::exchange(met[column], i) != i)
            found.push_back(column);
    std::sort(found.begin() + row_start(i), found.end());
    row_start(i + 1) = found.size();
  }
  LocalColumns columns("columns", found.size());
  std::copy(found.begin(), found.end(), columns.data());
  return static_graph(P.getDomainMap(), P.getColMap(), row_start, columns, P.getDomainMap());
}

}  // namespace

bool TripleProduct::serves(const CrsMatrix& A, const CrsMatrix& P) {
  return A.getComm()->getSize() == 1 && A.getRowMap()->isSameAs(*P.getRowMap()) &&
         A.getColMap()->isSameAs(*P.getRowMap()) && P.getColMap()->isSameAs(*P.getDomainMap());
}

TripleProduct::TripleProduct(const CrsMatrix& A, const CrsMatrix& P) : A_(&A), P_(&P) {
  if (!serves(A, P)) throw std::invalid_argument("TripleProduct: not for these matrices");
  product_ = matrix_on(triple_graph(A, P));
}

void TripleProduct::refresh() {
  product_->resumeFill();
  Tpetra::TripleMatrixMultiply::MultiplyRAP(*P_, true, *A_, false, *P_, false, *product_);
}

}  // namespace tunica::algebra
