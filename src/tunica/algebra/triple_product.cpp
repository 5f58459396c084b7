#include "tunica/algebra/triple_product.hpp"

#include <algorithm>
#include <numeric>
#include <stdexcept>
#include <utility>

#include "tunica/algebra/static_matrix.hpp"
#include "tunica/base/trilinos.hpp"

namespace tunica::algebra {

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

template <class Graph>
bool have_same_columns(const Graph& A, int i, int j) {
  const auto *first = A.entries.data() + A.row_map(i), *last = A.entries.data() + A.row_map(i + 1);
  return std::equal(first, last, A.entries.data() + A.row_map(j),
                    A.entries.data() + A.row_map(j + 1));
}

/// The columns of A P, for each group of rows.
struct ProductColumns {
  std::vector<std::size_t> start{0};  ///< by group
  std::vector<int> columns;

  template <class Graph>
  ProductColumns(const Graph& A, const Groups& rows, const Graph& P, int n_columns) {
    std::vector<int> met(n_columns, -1);
    for (int g = 0; g < rows.size(); ++g) {
      const int i = rows.start[g];
      for (auto l = A.row_map(i); l < A.row_map(i + 1); ++l)
        for (auto j = P.row_map(A.entries(l)); j < P.row_map(A.entries(l) + 1); ++j)
          if (const int column = P.entries(j); std::exchange(met[column], g) != g)
            columns.push_back(column);
      start.push_back(columns.size());
    }
  }
};

/// That of Pᵀ A P, on one rank. Tpetra's own takes room for three times its values while it
/// looks for it.
Teuchos::RCP<CrsGraph> triple_graph(const CrsMatrix& A, const Groups& rows, const CrsMatrix& P) {
  const auto of_A = A.getLocalMatrixHost().graph, of_P = P.getLocalMatrixHost().graph;
  const TransposedGraph Pt(P);
  const int n_coarse = static_cast<int>(Pt.start.size()) - 1;
  const ProductColumns AP(of_A, rows, of_P, n_coarse);
  RowStart row_start("row start", n_coarse + 1);
  std::vector<int> found, met(n_coarse, -1);  // met: the last row that has the column
  for (int i = 0, last = -1; i < n_coarse; ++i, last = -1) {
    for (std::size_t k = Pt.start[i]; k < Pt.start[i + 1]; ++k) {
      const int group = rows.of[Pt.columns[k]];
      if (std::exchange(last, group) == group) continue;
      for (std::size_t j = AP.start[group]; j < AP.start[group + 1]; ++j)
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

/// Columns, or rows, that a register of doubles holds.
constexpr int width = Groups::most;

/// v ← v + a w
void add(double a, const double* w, double* v) {
  for (int r = 0; r < width; ++r) v[r] += a * w[r];
}

/// Rows that follow each other and have the same columns.
template <class Graph>
Groups groups_of(const Graph& graph) {
  const int n_rows = static_cast<int>(graph.row_map.extent(0)) - 1;
  Groups groups;
  for (int i = 0; i < n_rows; ++i) {
    if (i == 0 || i - groups.start.back() == width || !have_same_columns(graph, i - 1, i))
      groups.start.push_back(i);
    groups.of.push_back(static_cast<int>(groups.start.size()) - 1);
  }
  groups.start.push_back(n_rows);
  return groups;
}

/// Every row has all columns of a group or none.
template <class Graph>
bool fit(const Groups& groups, const Graph& graph) {
  for (std::size_t i = 0; i + 1 < graph.row_map.extent(0); ++i)
    for (auto k = graph.row_map(i); k < graph.row_map(i + 1);) {
      const int group = groups.of[graph.entries(k)];
      for (int c = groups.start[group]; c < groups.start[group + 1]; ++c, ++k)
        if (k == graph.row_map(i + 1) || graph.entries(k) != c) return false;
    }
  return true;
}

Groups single_columns(int n) {
  Groups groups;
  groups.start.resize(n + 1);
  std::iota(groups.start.begin(), groups.start.end(), 0);
  groups.of.assign(groups.start.begin(), groups.start.end() - 1);
  return groups;
}

/// Groups of rows whose products are held at once: as many as fit a cache.
constexpr int chunk = 64;

}  // namespace

bool TripleProduct::serves(const CrsMatrix& A, const CrsMatrix& P) {
  return A.getComm()->getSize() == 1 && A.getRowMap()->isSameAs(*P.getRowMap()) &&
         A.getColMap()->isSameAs(*P.getRowMap()) && P.getColMap()->isSameAs(*P.getDomainMap());
}

TripleProduct::TripleProduct(const CrsMatrix& A, const CrsMatrix& P) : A_(&A), P_(&P) {
  if (!serves(A, P)) throw std::invalid_argument("TripleProduct: not for these matrices");
  fine_ = groups_of(A.getLocalMatrixHost().graph);
  product_ = matrix_on(triple_graph(A, fine_, P));
  const auto of_P = P.getLocalMatrixHost().graph, of_C = product_->getLocalMatrixHost().graph;
  coarse_ = groups_of(of_C);
  if (!fit(coarse_, of_C)) coarse_ = single_columns(static_cast<int>(n_local_rows(*product_)));
  std::vector<int> met(coarse_.size(), -1);
  for (int g = 0; g < fine_.size(); ++g) {
    for (auto k = of_P.row_map(fine_.start[g]); k < of_P.row_map(fine_.start[g + 1]); ++k)
      if (const int G = coarse_.of[of_P.entries(k)]; std::exchange(met[G], g) != g)
        parents_.push_back(G);
    parent_start_.push_back(parents_.size());
  }
}

/// For a chunk of groups g of rows: A_g· P and P_g·, then C_p· ← C_p· + P_gpᵀ A_g· P for the
/// parents p. Those of neighbours are mostly the same, and a row of C is looked up once for all.
class TripleProduct::Chunk {
public:
  explicit Chunk(const TripleProduct& whole)
      : whole_(whole), fine_(whole.fine_), coarse_(whole.coarse_),
        A_(whole.A_->getLocalMatrixHost()), P_(whole.P_->getLocalMatrixHost()),
        C_(whole.product_->getLocalMatrixHost()), W_(width * (coarse_.of.size() + width), 0.0),
        met_(coarse_.size(), -1), slot_(coarse_.size()), place_(coarse_.size()) {}

  void clear() {
    products_.clear();
    parents_.clear();
    start_.assign(1, 0);
  }

  void append(int g) {
    const std::size_t begin = products_.size();
    append_columns(g);
    multiply(g);
    for (std::size_t t = begin; t < products_.size(); ++t) take_product(products_[t]);
    start_.push_back(products_.size());
    append_parents(g);
  }

  void add_to_product() {
    std::vector<int> order(parents_.size());
    std::iota(order.begin(), order.end(), 0);
    std::stable_sort(order.begin(), order.end(),
                     [this](int a, int b) { return parents_[a].coarse < parents_[b].coarse; });
    int placed = -1;
    for (const int q : order) {
      const Parent& parent = parents_[q];
      if (std::exchange(placed, parent.coarse) != parent.coarse) find_places(parent.coarse);
      const int begin = coarse_.start[parent.coarse], end = coarse_.start[parent.coarse + 1];
      for (int p = begin; p < end; ++p)
        add_row(Weights(parent.weights[p - begin]), parent.group,
                C_.values.data() + C_.graph.row_map(p));
    }
  }

private:
  using Matrix = CrsMatrix::local_matrix_host_type;

  /// Weights of a column that are not zero, and their rows.
  struct Weights {
    int n = 0;
    int rows[width];
    double values[width];

    explicit Weights(const double* of_rows) {
      for (int r = 0; r < width; ++r) {
        if (of_rows[r] == 0.0) continue;
        rows[n] = r;
        values[n++] = of_rows[r];
      }
    }
  };

  /// A group of fine rows and one of coarse columns.
  struct Share {
    int coarse;
    double of[width][width];
  };

  /// A parent of a group of rows, in a chunk of such groups.
  struct Parent {
    int coarse, group;
    double weights[width][width];  ///< by column and row
  };

  /// Groups of columns that A_g· P has.
  void append_columns(int g) {
    const int first = fine_.start[g];
    int last = -1;
    for (auto k = A_.graph.row_map(first); k < A_.graph.row_map(first + 1); ++k) {
      const int h = fine_.of[A_.graph.entries(k)];
      if (std::exchange(last, h) == h) continue;
      for (std::size_t q = whole_.parent_start_[h]; q < whole_.parent_start_[h + 1]; ++q)
        if (const int G = whole_.parents_[q]; std::exchange(met_[G], g) != g)
          products_.push_back({G, {}});
    }
  }

  /// W = A_g· P
  void multiply(int g) {
    const int first = fine_.start[g], n = fine_.start[g + 1] - first;
    const auto start = A_.graph.row_map(first), length = A_.graph.row_map(first + 1) - start;
    double* const W = W_.data();
    for (std::size_t k = 0; k < length; ++k) {
      double a[width] = {};
      for (int r = 0; r < n; ++r) a[r] = A_.values(start + r * length + k);
      const int i = A_.graph.entries(start + k);
      for (auto j = P_.graph.row_map(i); j < P_.graph.row_map(i + 1); ++j)
        add(P_.values(j), a, W + width * P_.graph.entries(j));
    }
  }

  /// Its columns of a group, and leaves zeros.
  void take_product(Share& product) {
    const int begin = coarse_.start[product.coarse], end = coarse_.start[product.coarse + 1];
    for (int c = begin; c < end; ++c)
      for (int r = 0; r < width; ++r)
        product.of[r][c - begin] = std::exchange(W_[width * static_cast<std::size_t>(c) + r], 0.0);
  }

  void append_parents(int g) {
    const auto group = static_cast<int>(start_.size()) - 2;
    const std::size_t before = parents_.size();
    for (std::size_t q = whole_.parent_start_[g]; q < whole_.parent_start_[g + 1]; ++q) {
      slot_[whole_.parents_[q]] = static_cast<int>(parents_.size());
      parents_.push_back({whole_.parents_[q], group, {}});
    }
    if (parents_.size() == before) return;
    for (int i = fine_.start[g]; i < fine_.start[g + 1]; ++i)
      for (auto j = P_.graph.row_map(i); j < P_.graph.row_map(i + 1); ++j) {
        const int p = P_.graph.entries(j), G = coarse_.of[p];
        parents_[slot_[G]].weights[p - coarse_.start[G]][i - fine_.start[g]] = P_.values(j);
      }
  }

  /// Of the groups of columns in the rows of such a group.
  void find_places(int group) {
    const int row = coarse_.start[group];
    const auto begin = C_.graph.row_map(row), end = C_.graph.row_map(row + 1);
    for (auto k = begin; k < end;) {
      const int G = coarse_.of[C_.graph.entries(k)];
      place_[G] = static_cast<int>(k - begin);
      k += coarse_.start[G + 1] - coarse_.start[G];
    }
  }

  /// C_p· ← C_p· + Σ_r P_rp (A P)_r·
  void add_row(const Weights& weights, int group, double* row) const {
    if (weights.n == 0) return;
    for (std::size_t t = start_[group]; t < start_[group + 1]; ++t) {
      const Share& product = products_[t];
      double sum[width] = {};
      for (int r = 0; r < weights.n; ++r) add(weights.values[r], product.of[weights.rows[r]], sum);
      const int G = product.coarse, m = coarse_.start[G + 1] - coarse_.start[G];
      double* const values = row + place_[G];
      if (m == width)
        add(1.0, sum, values);
      else
        for (int c = 0; c < m; ++c) values[c] += sum[c];
    }
  }

  const TripleProduct& whole_;
  const Groups &fine_, &coarse_;
  Matrix A_, P_, C_;
  std::vector<double> W_;  ///< by column and row
  std::vector<int> met_, slot_, place_;
  std::vector<Share> products_;     ///< by row and column
  std::vector<std::size_t> start_;  ///< of those of a group
  std::vector<Parent> parents_;
};

void TripleProduct::refresh() {
  product_->resumeFill();
  {
    const auto values = product_->getLocalMatrixHost().values;
    for (std::size_t k = 0; k < values.extent(0); ++k) values(k) = 0.0;
    Chunk part(*this);
    for (int g = 0; g < fine_.size();) {
      part.clear();
      for (const int end = std::min(g + chunk, fine_.size()); g < end; ++g) part.append(g);
      part.add_to_product();
    }
  }
  product_->fillComplete(product_->getDomainMap(), product_->getRangeMap());
}

}  // namespace tunica::algebra
