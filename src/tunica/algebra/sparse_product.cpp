#include "tunica/algebra/sparse_product.hpp"

#include <TpetraExt_MatrixMatrix.hpp>
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

/// The columns of A P, for all rows of A that have the same: those of a node.
struct ProductColumns {
  std::vector<int> set_of_row;
  std::vector<std::size_t> start{0};  ///< of each set
  std::vector<int> columns;

  template <class Graph>
  ProductColumns(const Graph& A, const Graph& P, int n_columns) {
    const int n_rows = static_cast<int>(A.row_map.extent(0)) - 1;
    std::vector<int> met(n_columns, -1);
    for (int i = 0; i < n_rows; ++i) {
      if (i == 0 || !is_same(A, i - 1, i)) {
        const int set = static_cast<int>(start.size()) - 1;
        for (auto l = A.row_map(i); l < A.row_map(i + 1); ++l)
          for (auto j = P.row_map(A.entries(l)); j < P.row_map(A.entries(l) + 1); ++j)
            if (const int column = P.entries(j); std::exchange(met[column], set) != set)
              columns.push_back(column);
        start.push_back(columns.size());
      }
      set_of_row.push_back(static_cast<int>(start.size()) - 2);
    }
  }

private:
  template <class Graph>
  static bool is_same(const Graph& A, int i, int j) {
    const auto *first = A.entries.data() + A.row_map(i),
               *last = A.entries.data() + A.row_map(i + 1);
    return std::equal(first, last, A.entries.data() + A.row_map(j),
                      A.entries.data() + A.row_map(j + 1));
  }
};

/// That of Pᵀ A P, on one rank. Tpetra's own takes room for three times its values while it
/// looks for it.
Teuchos::RCP<CrsGraph> triple_graph(const CrsMatrix& A, const CrsMatrix& P) {
  const auto of_A = A.getLocalMatrixHost().graph, of_P = P.getLocalMatrixHost().graph;
  const TransposedGraph Pt(P);
  const int n_coarse = static_cast<int>(Pt.start.size()) - 1;
  const ProductColumns AP(of_A, of_P, n_coarse);
  RowStart row_start("row start", n_coarse + 1);
  std::vector<int> found, met(n_coarse, -1);  // met: the last row that has the column
  for (int i = 0, last = -1; i < n_coarse; ++i, last = -1) {
    for (std::size_t k = Pt.start[i]; k < Pt.start[i + 1]; ++k) {
      const int set = AP.set_of_row[Pt.columns[k]];
      if (std::exchange(last, set) == set) continue;
      for (std::size_t j = AP.start[set]; j < AP.start[set + 1]; ++j)
        if (const int column = AP.columns[j]; std::exchange(met[column], i) != i)
          found.push_back(column);
    }
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

// C = Σ_i P_i·ᵀ (A_i· P): a row of A P at a time, added to the rows of the parents of i. Tpetra's
// own goes by rows of C and multiplies each A_ik by the pairs of parents of i and k, which is many
// times as much where nodes have blocks for parents.
void TripleProduct::refresh() {
  product_->resumeFill();
  {
    const auto A = A_->getLocalMatrixHost(), P = P_->getLocalMatrixHost(),
               C = product_->getLocalMatrixHost();
    for (std::size_t k = 0; k < C.values.extent(0); ++k) C.values(k) = 0.0;
    std::vector<double> row(n_local(*P_->getColMap()), 0.0);  // A_i· P; zero between rows
    double* const w = row.data();
    const auto for_parents = [&P](int k, const auto& work) {
      for (auto j = P.graph.row_map(k); j < P.graph.row_map(k + 1); ++j)
        work(P.graph.entries(j), P.values(j));
    };
    for (int i = 0; i < A.numRows(); ++i) {
      if (P.graph.row_map(i) == P.graph.row_map(i + 1)) continue;
      const auto a = A.rowConst(i);
      for (int k = 0; k < a.length; ++k) {
        const double value = a.value(k);
        for_parents(a.colidx(k), [&](int j, double p) { w[j] += value * p; });
      }
      for_parents(i, [&](int parent, double p) {
        for (auto q = C.graph.row_map(parent); q < C.graph.row_map(parent + 1); ++q)
          C.values(q) += p * w[C.graph.entries(q)];
      });
      for (int k = 0; k < a.length; ++k)
        for_parents(a.colidx(k), [&](int j, double) { w[j] = 0.0; });
    }
  }
  product_->fillComplete(product_->getDomainMap(), product_->getRangeMap());
}

}  // namespace tunica::algebra
