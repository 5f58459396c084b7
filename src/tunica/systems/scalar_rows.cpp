#include "tunica/systems/scalar_rows.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "tunica/base/error.hpp"
#include "tunica/base/reduce.hpp"
#include "tunica/base/rows.hpp"
#include "tunica/systems/unknown_order.hpp"

namespace tunica::systems {

namespace {

/// What the diagonal of a row is: a row with nothing beside it may be of a vector or of a scalar.
enum Diagonal : char { positive, negative, zero, alone };

std::vector<char> kinds_of_rows(const MatrixRows& K) {
  std::vector<char> kinds;
  for (std::size_t i = 0; i < K.n_local_rows(); ++i) {
    double d = 0.0, largest = 0.0;
    for (std::size_t k = K.start[i]; k < K.start[i + 1]; ++k) {
      const bool is_diagonal = K.columns[k] == K.first_row() + static_cast<long long>(i);
      if (is_diagonal) d = K.values[k];
      if (!is_diagonal) largest = std::max(largest, std::abs(K.values[k]));
    }
    kinds.push_back(largest == 0.0                      ? alone
                    : std::abs(d) <= rounding * largest ? zero
                    : d < 0.0                           ? negative
                                                        : positive);
  }
  std::vector<long long> all(static_cast<std::size_t>(K.n_rows));
  std::iota(all.begin(), all.end(), 0LL);
  return fetch(*K.comm, all, kinds, K.n_rows);
}

/// A regular order of the unknowns: scalars in front, behind, or at a place of each node.
struct Layout {
  enum Where { first, last, in_node } where;
  int components;
  int place = 0;  ///< in the node

  bool fits(long long n) const { return n % (components + 1) == 0 && n > components; }
  bool is_scalar(long long row, long long n) const {
    const long long nodes = n / (components + 1);
    return where == first  ? row < nodes
           : where == last ? row >= n - nodes
                           : row % (components + 1) == place;
  }
  int in_nodes() const { return where == in_node ? components : 0; }
  std::string text() const {
    return where == first  ? "scalars first"
           : where == last ? "scalars last"
                           : "scalars at place " + std::to_string(place + 1) + " of the " +
                                 std::to_string(components + 1) + " unknowns of each node";
  }
};

std::vector<Layout> regular_layouts(long long n) {
  std::vector<Layout> all;
  for (const int c : {3, 2, 1}) {
    all.push_back({Layout::last, c});
    all.push_back({Layout::first, c});
    for (int place = c; place >= 0; --place) all.push_back({Layout::in_node, c, place});
  }
  all.erase(std::remove_if(all.begin(), all.end(), [n](const Layout& l) { return !l.fits(n); }),
            all.end());
  return all;
}

std::vector<char> rows_of(const Layout& layout, long long n) {
  std::vector<char> is_scalar;
  for (long long row = 0; row < n; ++row) is_scalar.push_back(layout.is_scalar(row, n) ? 1 : 0);
  return is_scalar;
}

/// Of the pairs of entries K_ij K_ji ≠ 0, i < j, for a layout.
struct Pairs {
  double judged = 0.0, against = 0.0;  ///< of these those that contradict it
  double across = 0.0;                 ///< between vectors and scalars
};

/// is_convective: pairs of vectors have any sign, and those across are K_ij = −K_ji exactly.
std::vector<Pairs> count_pairs(const MatrixRows& K, const std::vector<Layout>& layouts,
                               bool is_convective) {
  const MatrixRows T = transposed(K);
  std::vector<double> counts(3 * layouts.size(), 0.0);
  const auto note = [&](long long i, long long j, double there, double back) {
    const bool is_opposite =
        is_convective ? std::abs(there + back) <= 1e-8 * std::abs(there) : there * back < 0.0;
    for (std::size_t l = 0; l < layouts.size(); ++l) {
      const bool of_i = layouts[l].is_scalar(i, K.n_rows), of_j = layouts[l].is_scalar(j, K.n_rows);
      if (is_convective && !of_i && !of_j) continue;
      ++counts[3 * l];
      counts[3 * l + 1] += (of_i != of_j) != is_opposite;
      counts[3 * l + 2] += of_i != of_j;
    }
  };
  for (std::size_t i = 0; i < K.n_local_rows(); ++i) {
    const long long row = K.first_row() + static_cast<long long>(i);
    for (std::size_t k = K.start[i], t = T.start[i]; k < K.start[i + 1]; ++k) {
      while (t < T.start[i + 1] && T.columns[t] < K.columns[k]) ++t;
      if (t == T.start[i + 1]) break;
      if (T.columns[t] == K.columns[k] && K.columns[k] > row && K.values[k] * T.values[t] != 0.0)
        note(row, K.columns[k], K.values[k], T.values[t]);
    }
  }
  counts = global_sum(*K.comm, counts);
  std::vector<Pairs> pairs;
  for (std::size_t l = 0; l < layouts.size(); ++l)
    pairs.push_back({counts[3 * l], counts[3 * l + 1], counts[3 * l + 2]});
  return pairs;
}

/// [A B; −Bᵀ C]: the regular layout that at most a twentieth of the pairs contradict.
ScalarRows scalars_by_pairs(const MatrixRows& K) {
  const std::vector<Layout> layouts = regular_layouts(K.n_rows);
  for (const bool is_convective : {false, true}) {
    const std::vector<Pairs> pairs = count_pairs(K, layouts, is_convective);
    double least = 0.05;
    const Layout* best = nullptr;
    for (std::size_t l = 0; l < layouts.size(); ++l) {
      const auto& [judged, against, across] = pairs[l];
      if (across < 0.05 * judged || against >= least * judged) continue;
      least = against / judged;
      best = &layouts[l];
    }
    if (best != nullptr)
      return {rows_of(*best, K.n_rows), 1.0, -1.0, best->text(), best->in_nodes()};
  }
  return {std::vector<char>(static_cast<std::size_t>(K.n_rows), 0), 1.0, 1.0, "no scalars"};
}

/// Rows that are alone stand where a regular layout wants them, if there is one; true then.
bool spread_regularly(const std::vector<char>& kinds, ScalarRows& found) {
  const auto n = static_cast<long long>(kinds.size());
  for (const Layout& layout : regular_layouts(n)) {
    bool fits = true;
    for (long long row = 0; row < n && fits; ++row)
      fits = kinds[row] == alone || (found.is_scalar[row] != 0) == layout.is_scalar(row, n);
    if (!fits) continue;
    found.is_scalar = rows_of(layout, n);
    found.text = layout.text();
    found.in_nodes = layout.in_nodes();
    return true;
  }
  return false;
}

/// Otherwise they go with their neighbours, where rows of the one kind and of the other stand in
/// two stretches.
void spread_to_lone_rows(const MatrixRows& K, const std::vector<char>& kinds,
                         const Teuchos::ParameterList& options, ScalarRows& found) {
  std::vector<char>& is_scalar = found.is_scalar;
  const auto at = [&](long long row) { return is_scalar.begin() + row; };
  const auto n = static_cast<long long>(kinds.size());
  const long long begin = std::find(at(0), at(n), 1) - at(0);
  const long long end = std::find(is_scalar.rbegin(), is_scalar.rend(), 1).base() - at(0);
  long long first = n, last = 0;  // vectors
  bool has_within = false;
  for (long long row = 0; row < n; ++row) {
    if (kinds[row] == alone || is_scalar[row] != 0) continue;
    first = std::min(first, row);
    last = row + 1;
    has_within = has_within || (row > begin && row < end);
  }
  found.text = "scalars among the vectors";
  if (has_within) return;
  std::fill(at(begin), at(end), char{1});
  found.text = "scalars in one stretch";
  if (last <= begin) {
    const Stretch vectors = even_stretch(K, is_scalar, {0, begin}, begin - last, options);
    std::fill(at(vectors.last), at(n), char{1});
    found.text = "scalars last";
  } else if (first >= end) {
    const Stretch vectors = even_stretch(K, is_scalar, {end, n}, first - end, options);
    std::fill(at(0), at(vectors.first), char{1});
    found.text = "scalars first";
  }
}

/// Where scalars may stand: the last and the first rows that are scalars or alone, and the regular
/// layouts that have none but these.
std::vector<std::vector<char>> likely_places(const std::vector<char>& kinds,
                                             const std::vector<char>& is_scalar) {
  const auto n = static_cast<long long>(kinds.size());
  const auto may_be = [&](long long row) { return is_scalar[row] != 0 || kinds[row] == alone; };
  long long behind = n, in_front = 0;
  while (behind > 0 && may_be(behind - 1)) --behind;
  while (in_front < n && may_be(in_front)) ++in_front;
  std::vector<std::vector<char>> all(2, std::vector<char>(kinds.size(), 0));
  std::fill(all[0].begin() + behind, all[0].end(), char{1});
  std::fill(all[1].begin(), all[1].begin() + in_front, char{1});
  for (const Layout& layout : regular_layouts(n)) {
    bool fits = true;
    for (long long row = 0; row < n && fits; ++row) fits = !layout.is_scalar(row, n) || may_be(row);
    if (fits) all.push_back(rows_of(layout, n));
  }
  return all;
}

/// Rows of vectors in a flow: each is coupled with scalars at these places, and with another vector
/// in one way there and in another one back, as no scalar is.
bool are_convected(const MatrixRows& K, const MatrixRows& T, const std::vector<char>& is_scalar,
                   const std::vector<char>& places) {
  bool are_so = true;
  for (std::size_t i = 0; i < K.n_local_rows(); ++i) {
    const long long row = K.first_row() + static_cast<long long>(i);
    if (is_scalar[row] == 0 || places[row] != 0) continue;
    bool has_scalar = false, has_other_way = false;
    for (std::size_t k = K.start[i], t = T.start[i]; k < K.start[i + 1]; ++k) {
      const double there = K.values[k];
      if (is_scalar[K.columns[k]] != 0) {
        has_scalar = has_scalar || (places[K.columns[k]] != 0 && there != 0.0);
        continue;
      }
      while (t < T.start[i + 1] && T.columns[t] < K.columns[k]) ++t;
      const bool has_back = t < T.start[i + 1] && T.columns[t] == K.columns[k];
      const double back = has_back ? T.values[t] : 0.0;
      has_other_way =
          has_other_way || (there * back != 0.0 &&
                            std::abs(std::abs(there) - std::abs(back)) > 1e-8 * std::abs(there));
    }
    are_so = are_so && has_scalar && has_other_way;
  }
  return all_agree(*K.comm, are_so);
}

/// Convection turns the sign of some diagonals of vectors. These rows go with their neighbours
/// where they are few and the others stand at a likely place.
void return_convected(const MatrixRows& K, const std::vector<char>& kinds,
                      std::vector<char>& is_scalar) {
  constexpr double few = 0.1;
  MatrixRows T;  // Kᵀ, made where it is needed
  for (const std::vector<char>& places : likely_places(kinds, is_scalar)) {
    double vectors = 0.0, scalars = 0.0, outliers = 0.0, zeros = 0.0;
    for (std::size_t row = 0; row < kinds.size(); ++row) {
      vectors += kinds[row] != alone && is_scalar[row] == 0;
      scalars += is_scalar[row] != 0 && places[row] != 0;
      outliers += is_scalar[row] != 0 && places[row] == 0;
      zeros += kinds[row] == zero && places[row] == 0;
    }
    if (outliers == 0.0) return;
    if (zeros > 0.0 || outliers > few * vectors || outliers > scalars) continue;
    if (T.n_rows == 0) T = transposed(K);
    if (!are_convected(K, T, is_scalar, places)) continue;
    for (std::size_t row = 0; row < kinds.size(); ++row)
      is_scalar[row] = is_scalar[row] != 0 && places[row] != 0;
    return;
  }
}

/// Scalars where the diagonal is zero or not of this sign; true for a regular order.
std::pair<ScalarRows, bool> where_not(char of_vectors, const MatrixRows& K,
                                      const std::vector<char>& kinds,
                                      const Teuchos::ParameterList& options) {
  const char of_scalars = of_vectors == positive ? negative : positive;
  ScalarRows found;
  for (const char kind : kinds)
    found.is_scalar.push_back(kind == zero || kind == of_scalars ? 1 : 0);
  found.vector_sign = found.scalar_sign = of_vectors == positive ? 1.0 : -1.0;
  return_convected(K, kinds, found.is_scalar);
  const bool is_regular = spread_regularly(kinds, found);
  if (!is_regular) spread_to_lone_rows(K, kinds, options, found);
  return {found, is_regular};
}

// Vectors are the more frequent ones. Where most of their values are prescribed they need not be:
// then it is the sign with which the order is a regular one.
ScalarRows scalars_by_signs(const MatrixRows& K, const Teuchos::ParameterList& options) {
  const std::vector<char> kinds = kinds_of_rows(K);
  const auto count = [&](char kind) { return std::count(kinds.begin(), kinds.end(), kind); };
  const char of_vectors = count(negative) > count(positive) ? negative : positive;
  const char of_others = of_vectors == positive ? negative : positive;
  if (count(zero) + count(of_others) == 0) {
    const double sign = of_vectors == positive ? 1.0 : -1.0;
    ScalarRows found = scalars_by_pairs(K);
    found.vector_sign *= sign;
    found.scalar_sign *= sign;
    return found;
  }
  const auto [found, is_regular] = where_not(of_vectors, K, kinds, options);
  if (is_regular || count(of_others) == 0) return found;
  const auto [other, is_other_regular] = where_not(of_others, K, kinds, options);
  return is_other_regular ? other : found;
}

ScalarRows scalars_as_given(const MatrixRows& K, const Teuchos::ParameterList& options) {
  const auto& where = options.get<std::string>("scalars");
  const long long n = K.n_rows;
  const int components = options.get<int>("components");
  const long long given = options.get<int>("scalar unknowns");
  ScalarRows rows;
  rows.text = where == "none" ? "no scalars" : "scalars " + where;
  rows.is_scalar.assign(static_cast<std::size_t>(n), 0);
  if (where == "none") return rows;
  TUNICA_CHECK(components > 0 || given > 0, "System: \"scalars\" = \"" + where +
                                                "\" needs \"components\", for as many scalars "
                                                "as nodes, or \"scalar unknowns\".");
  const long long m = given > 0 ? given : n / (components + 1);
  TUNICA_CHECK(m < n && (given > 0 || n % (components + 1) == 0),
               "System: K has " + std::to_string(n) +
                   " rows, which do not fit \"components\" = " + std::to_string(components) +
                   " and \"scalar unknowns\" = " + std::to_string(given) + ".");
  const int place = where == "first in node" ? 0 : components;
  if (where != "first" && where != "last") rows.in_nodes = components;
  for (long long row = 0; row < n; ++row)
    rows.is_scalar[row] = where == "first"  ? row < m
                          : where == "last" ? row >= n - m
                                            : row % (components + 1) == place;
  return rows;
}

}  // namespace

ScalarRows find_scalars(const MatrixRows& K, const Teuchos::ParameterList& options) {
  if (options.get<std::string>("scalars") != "automatic") return scalars_as_given(K, options);
  const ScalarRows found = scalars_by_signs(K, options);
  const int given = options.get<int>("scalar unknowns");
  if (given == 0 || std::count(found.is_scalar.begin(), found.is_scalar.end(), 1) == given)
    return found;
  Teuchos::ParameterList with_place(options);
  const bool is_first = found.is_scalar.front() != 0 && found.is_scalar.back() == 0;
  with_place.set<std::string>("scalars", is_first ? "first" : "last");
  ScalarRows as_given = scalars_as_given(K, with_place);
  as_given.vector_sign = found.vector_sign;
  as_given.scalar_sign = found.scalar_sign;
  return as_given;
}

}  // namespace tunica::systems
