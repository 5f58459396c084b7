#include "tunica/algebra/products/triple_kernel.hpp"

#include <algorithm>
#include <limits>
#include <numeric>
#include <stdexcept>
#include <utility>

#include "tunica/base/pack.hpp"

namespace tunica::algebra {

namespace {

static_assert(Groups::most == Pack::size);
constexpr int width = Groups::most;
constexpr int block = width * width;

using Graph = TripleKernel::Graph;

/// The rows of Pᵀ, of some rows of P, whatever the values.
struct TransposedGraph {
  std::vector<std::size_t> start;
  std::vector<int> columns;

  TransposedGraph(const Graph& P, const std::vector<int>& rows, int n_columns)
      : start(n_columns + 1, 0) {
    for (const int row : rows)
      for (auto k = P.row_map(row); k < P.row_map(row + 1); ++k) ++start[P.entries(k) + 1];
    std::partial_sum(start.begin(), start.end(), start.begin());
    std::vector<std::size_t> next(start.begin(), start.end() - 1);
    columns.resize(start.back());
    for (std::size_t i = 0; i < rows.size(); ++i)
      for (auto k = P.row_map(rows[i]); k < P.row_map(rows[i] + 1); ++k)
        columns[next[P.entries(k)]++] = static_cast<int>(i);
  }
};

/// Columns that follow each other and are in the same rows.
Groups groups_of_columns(int n, const std::vector<std::size_t>& start,
                         const std::vector<int>& columns) {
  std::vector<int> rows(n, 0), rows_with_last(n, 0);  // that have it; that have the one before, too
  for (std::size_t i = 0; i + 1 < start.size(); ++i)
    for (std::size_t k = start[i]; k < start[i + 1]; ++k) {
      ++rows[columns[k]];
      if (k > start[i] && columns[k - 1] == columns[k] - 1) ++rows_with_last[columns[k]];
    }
  return groups_of(n,
                   [&](int c) { return rows[c] == rows[c - 1] && rows[c] == rows_with_last[c]; });
}

/// work(column) once for each column of A P in the rows of a group. met: by column, the last group
/// that had it.
template <class Work>
void for_product(const Graph& A, int row, int group, const Graph& P, std::vector<int>& met,
                 const Work& work) {
  for (auto k = A.row_map(row); k < A.row_map(row + 1); ++k)
    for (auto j = P.row_map(A.entries(k)); j < P.row_map(A.entries(k) + 1); ++j)
      if (const int column = P.entries(j); std::exchange(met[column], group) != group) work(column);
}

}  // namespace

TripleKernel::TripleKernel(const Graph& A, const Graph& P, std::vector<int> diagonal, int n_coarse)
    : diagonal_(std::move(diagonal)) {
  const auto start = [&](int i) { return A.row_map(i); };
  rows_ = groups_of_rows(n_rows(A), start, A.entries.data());
  find_graph(A, P, n_coarse);
  coarse_rows_ = groups_of_rows(
      n_coarse, [this](int i) { return row_start_[i]; }, columns_.data());
  coarse_columns_ = groups_of_columns(n_coarse, row_start_, columns_);
  find_groups(A, P);
  find_places();
}

// A row of C has the columns that A P has in any row of its children. The unknowns of a coarse node
// mostly have the same groups of children, so that one list of columns serves them all.
void TripleKernel::find_graph(const Graph& A, const Graph& P, int n_coarse) {
  std::vector<std::size_t> start{0};
  std::vector<int> columns, met(n_coarse, -1);
  for (int g = 0; g < rows_.size(); ++g) {
    for_product(A, rows_.start[g], g, P, met, [&](int c) { columns.push_back(c); });
    start.push_back(columns.size());
  }
  const TransposedGraph Pt(P, diagonal_, n_coarse);
  met.assign(n_coarse, -1);
  std::vector<std::size_t> list_start{0};
  std::vector<int> lists, list_of(n_coarse), children, last;
  for (int i = 0; i < n_coarse; ++i) {
    children.clear();
    for (std::size_t k = Pt.start[i]; k < Pt.start[i + 1]; ++k)
      if (const int g = rows_.of[Pt.columns[k]]; children.empty() || children.back() != g)
        children.push_back(g);
    if (i == 0 || children != last) {
      for (const int g : children)
        for (std::size_t j = start[g]; j < start[g + 1]; ++j)
          if (std::exchange(met[columns[j]], i) != i) lists.push_back(columns[j]);
      std::sort(lists.begin() + static_cast<std::ptrdiff_t>(list_start.back()), lists.end());
      list_start.push_back(lists.size());
      last = children;
    }
    list_of[i] = static_cast<int>(list_start.size()) - 2;
  }
  row_start_.assign(1, 0);
  for (const int l : list_of)
    row_start_.push_back(row_start_.back() + list_start[l + 1] - list_start[l]);
  columns_.reserve(row_start_.back());
  for (const int l : list_of)
    columns_.insert(columns_.end(), lists.begin() + static_cast<std::ptrdiff_t>(list_start[l]),
                    lists.begin() + static_cast<std::ptrdiff_t>(list_start[l + 1]));
}

// Of a group of rows, the groups of columns of A P and the groups of rows of C it adds to.
void TripleKernel::find_groups(const Graph& A, const Graph& P) {
  std::vector<int> met(coarse_columns_.of.size(), -1), met_group(coarse_columns_.size(), -1),
      met_parent(coarse_rows_.size(), -1);
  for (int g = 0; g < rows_.size(); ++g) {
    for_product(A, rows_.start[g], g, P, met, [&](int column) {
      const int group = coarse_columns_.of[column];
      if (std::exchange(met_group[group], g) != g) products_.push_back(group);
    });
    product_start_.push_back(products_.size());
    for (int i = rows_.start[g]; i < rows_.start[g + 1]; ++i)
      for (auto k = P.row_map(diagonal_[i]); k < P.row_map(diagonal_[i] + 1); ++k)
        if (const int parent = coarse_rows_.of[P.entries(k)];
            std::exchange(met_parent[parent], g) != g)
          parents_.push_back(parent);
    parent_start_.push_back(parents_.size());
  }
  products_.shrink_to_fit();
  parents_.shrink_to_fit();
}

// Row by row of C: where its groups of columns begin, for all of its children.
void TripleKernel::find_places() {
  struct Child {
    std::size_t places;
    int group;
  };
  std::vector<std::size_t> next(coarse_rows_.size() + 1, 0);
  for (const int parent : parents_) ++next[parent + 1];
  std::partial_sum(next.begin(), next.end(), next.begin());
  const std::vector<std::size_t> first_child(next);
  std::vector<Child> children(parents_.size());
  std::size_t n_places = 0;
  for (int g = 0; g < rows_.size(); ++g)
    for (std::size_t q = parent_start_[g]; q < parent_start_[g + 1]; ++q) {
      children[next[parents_[q]]++] = {n_places, g};
      n_places += product_start_[g + 1] - product_start_[g];
    }
  places_.resize(n_places);
  std::vector<std::uint16_t> place(coarse_columns_.size());
  for (int G = 0; G < coarse_rows_.size(); ++G) {
    const auto begin = row_start_[coarse_rows_.start[G]],
               end = row_start_[coarse_rows_.start[G] + 1];
    if (end - begin > std::numeric_limits<std::uint16_t>::max())
      throw std::length_error("TripleKernel: a coarse row has too many entries");
    for (auto k = begin; k < end; k += coarse_columns_.length(coarse_columns_.of[columns_[k]]))
      place[coarse_columns_.of[columns_[k]]] = static_cast<std::uint16_t>(k - begin);
    for (auto c = first_child[G]; c < first_child[G + 1]; ++c) {
      auto at = children[c].places;
      const int g = children[c].group;
      for (auto t = product_start_[g]; t < product_start_[g + 1]; ++t)
        places_[at++] = place[products_[t]];
    }
  }
}

namespace {

/// v += a in the columns of a group, which mostly has four.
inline void add_to(double* v, const Pack& a, int n) {
  if (n == width) return (Pack::load(v) + a).store(v);
  v[0] += a[0];
  if (n > 1) v[1] += a[1];
  if (n > 2) v[2] += a[2];
}

/// Where the values of a local matrix are, not to be looked up again after each number stored.
struct Values {
  const CrsMatrix::local_matrix_host_type::size_type* start;
  const int* columns;
  const double* values;

  explicit Values(const TripleKernel::Matrix& matrix)
      : start(matrix.graph.row_map.data()), columns(matrix.graph.entries.data()),
        values(matrix.values.data()) {}
};

}  // namespace

/// Space of one group of rows at a time.
struct TripleKernel::Scratch {
  std::vector<double> by_columns, by_rows;  ///< blocks of the product, in either order
  std::vector<double> weights;              ///< by parent, column of P and row
  std::vector<int> column_place;            ///< by column of A P: in by_columns
  std::vector<int> parent_place;            ///< by group of rows of C: in weights
  std::vector<int> lengths;                 ///< of the groups of columns
};

// W = A_g P in blocks, which have the four rows of a column side by side while they are summed,
// and the four columns of a row afterwards.
inline void TripleKernel::multiply(int g, const Matrix& A, const Matrix& P, Scratch& s) const {
  const int first = rows_.start[g], n = rows_.length(g);
  const int* const products = products_.data() + product_start_[g];
  const auto n_products = static_cast<int>(product_start_[g + 1] - product_start_[g]);
  s.by_columns.assign(block * n_products, 0.0);
  s.by_rows.resize(block * n_products);
  s.lengths.resize(n_products);
  for (int t = 0; t < n_products; ++t) {
    s.lengths[t] = coarse_columns_.length(products[t]);
    for (int c = 0; c < s.lengths[t]; ++c)
      s.column_place[coarse_columns_.start[products[t]] + c] = block * t + width * c;
  }
  const Values from(A), weights(P);
  const auto start = from.start[first], length = from.start[first + 1] - start;
  double* const W = s.by_columns.data();
  const int* const place = s.column_place.data();
  for (std::size_t k = 0; k < length; ++k) {
    Pack a{};
    for (int r = 0; r < n; ++r) a.set(r, from.values[start + r * length + k]);
    const int i = from.columns[start + k];
    for (auto j = weights.start[i], end = weights.start[i + 1]; j < end; ++j) {
      double* const w = W + place[weights.columns[j]];
      (Pack::load(w) + weights.values[j] * a).store(w);
    }
  }
  double* const to = s.by_rows.data();
  for (int t = 0; t < n_products; ++t)
    for (int r = 0; r < width; ++r)
      for (int c = 0; c < width; ++c) to[block * t + width * r + c] = W[block * t + width * c + r];
}

inline void TripleKernel::gather_weights(int g, const Matrix& P, Scratch& s) const {
  const int* const parents = parents_.data() + parent_start_[g];
  const auto n_parents = static_cast<int>(parent_start_[g + 1] - parent_start_[g]);
  s.weights.assign(block * n_parents, 0.0);
  for (int q = 0; q < n_parents; ++q) s.parent_place[parents[q]] = block * q;
  const Values from(P);
  for (int i = rows_.start[g]; i < rows_.start[g + 1]; ++i)
    for (auto j = from.start[diagonal_[i]], end = from.start[diagonal_[i] + 1]; j < end; ++j) {
      const int p = from.columns[j], G = coarse_rows_.of[p];
      s.weights[s.parent_place[G] + width * (p - coarse_rows_.start[G]) + i - rows_.start[g]] =
          from.values[j];
    }
}

// C_p· ← C_p· + Σ_r P_rp W_r· for the parents p of a group
TUNICA_PACKED void TripleKernel::add(const Matrix& A, const Matrix& P,
                                     const std::vector<double*>& rows_of_C) const {
  Scratch s;
  s.column_place.resize(coarse_columns_.of.size());
  s.parent_place.resize(coarse_rows_.size());
  const std::uint16_t* places = places_.data();
  for (int g = 0; g < rows_.size(); ++g) {
    multiply(g, A, P, s);
    gather_weights(g, P, s);
    const auto n_products = static_cast<int>(product_start_[g + 1] - product_start_[g]);
    for (std::size_t q = parent_start_[g]; q < parent_start_[g + 1]; ++q, places += n_products) {
      const double* const w = s.weights.data() + block * (q - parent_start_[g]);
      const int first = coarse_rows_.start[parents_[q]], n = coarse_rows_.length(parents_[q]);
      double* const* const rows = rows_of_C.data() + first;
      for (int t = 0; t < n_products; ++t) {
        const double* const W = s.by_rows.data() + block * t;
        const Pack W0 = Pack::load(W), W1 = Pack::load(W + width), W2 = Pack::load(W + 2 * width),
                   W3 = Pack::load(W + 3 * width);
        for (int p = 0; p < n; ++p) {
          const double* const w_p = w + width * p;
          add_to(rows[p] + places[t], (w_p[0] * W0 + w_p[1] * W1) + (w_p[2] * W2 + w_p[3] * W3),
                 s.lengths[t]);
        }
      }
    }
  }
}

}  // namespace tunica::algebra
