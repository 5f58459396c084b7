#include "tunica/systems/unknown_order.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <set>

#include "tunica/base/reduce.hpp"
#include "tunica/base/rows.hpp"

namespace tunica::systems {

namespace {

/// A numbering of n unknowns.
struct Numbering {
  int components;
  bool is_by_node;
  long long node(long long row, long long n) const {
    return is_by_node ? row / components : row % (n / components);
  }
  long long row(long long node, int component, long long n) const {
    return is_by_node ? components * node + component : component * (n / components) + node;
  }
  int component(long long row, long long n) const {
    return static_cast<int>(is_by_node ? row % components : row / (n / components));
  }
};

/// How components are coupled.
enum class Coupling { none, of_vectors, of_others };

/// None, or such that most nodes couple their own components; others rarely are those of vectors.
Coupling coupling_of(const MatrixRows& A, const Numbering& numbering) {
  double across = 0.0, within_node = 0.0, rows = 0.0;
  for (std::size_t i = 0; i < A.n_local_rows(); ++i) {
    const long long row = A.first_row() + static_cast<long long>(i);
    bool is_across = false, is_within = false;
    for (std::size_t k = A.start[i]; k < A.start[i + 1]; ++k) {
      if (numbering.component(A.columns[k], A.n_rows) == numbering.component(row, A.n_rows))
        continue;
      is_across = true;
      is_within =
          is_within || numbering.node(A.columns[k], A.n_rows) == numbering.node(row, A.n_rows);
    }
    if (A.start[i + 1] - A.start[i] > 1) ++rows;
    across += is_across;
    within_node += is_within;
  }
  const std::vector<double> all = global_sum(*A.comm, std::vector{across, within_node, rows});
  return all[0] == 0.0           ? Coupling::none
         : all[1] > 0.5 * all[2] ? Coupling::of_vectors
                                 : Coupling::of_others;
}

/// Some of so many nodes, ascending: fractions of multiples of the golden section, as even steps
/// may fall on one side of a vessel or on the ends of all rows of a grid.
std::vector<long long> sample_of(long long nodes) {
  constexpr long long most = 400;
  constexpr double golden = 0.6180339887498949;
  std::set<long long> sample;
  for (long long k = 0; k < std::min(most, nodes); ++k)
    sample.insert(static_cast<long long>(std::fmod(k * golden, 1.0) * static_cast<double>(nodes)));
  return {sample.begin(), sample.end()};
}

/// What the rows of some nodes reach.
struct Sample {
  Numbering numbering;
  CommPtr comm;
  long long n;                  ///< unknowns
  std::vector<long long> rows;  ///< ascending, on rank 0
  /// The nodes that each row reaches in each component.
  std::vector<std::vector<std::set<long long>>> reached;

  std::set<long long> nodes_of(std::size_t k) const {
    std::set<long long> all;
    for (const auto& nodes : reached[k]) all.insert(nodes.begin(), nodes.end());
    return all;
  }
};

Sample sample(const MatrixRows& A, const Numbering& numbering) {
  Sample some{numbering, A.comm, A.n_rows, {}, {}};
  const int components = numbering.components;
  if (A.comm->getRank() == 0)
    for (const long long node : sample_of(A.n_rows / components))
      for (int c = 0; c < components; ++c) some.rows.push_back(numbering.row(node, c, A.n_rows));
  std::sort(some.rows.begin(), some.rows.end());
  some.reached.assign(some.rows.size(), std::vector<std::set<long long>>(components));
  for (const Entry& entry : fetch_rows(A, some.rows))
    if (entry.value != 0.0)
      some.reached[place_of(entry.row, some.rows)][numbering.component(entry.column, A.n_rows)]
          .insert(numbering.node(entry.column, A.n_rows));
  return some;
}

/// How alike the nodes are that the rows of a node reach, from 0 to 1.
double likeness(const Sample& some) {
  const auto& [numbering, comm, n, rows, reached] = some;
  double sum = 0.0, count = 0.0;
  for (std::size_t k = 0; k < rows.size(); ++k) {
    const long long node = numbering.node(rows[k], n);
    const std::set<long long> mine = some.nodes_of(k);
    for (int c = numbering.component(rows[k], n) + 1; c < numbering.components; ++c) {
      const std::set<long long> other = some.nodes_of(place_of(numbering.row(node, c, n), rows));
      if (mine.size() < 2 || other.size() < 2) continue;  // a prescribed value
      std::vector<long long> both;
      std::set_intersection(mine.begin(), mine.end(), other.begin(), other.end(),
                            std::back_inserter(both));
      sum += double(both.size()) / double(mine.size() + other.size() - both.size());
      ++count;
    }
  }
  sum = global_sum(*comm, sum);
  count = global_sum(*comm, count);
  return count > 0.0 ? sum / count : 0.0;
}

/// On bricks and rectangles the integral of ∂xφ ∂yφ vanishes at a node in the interior: components
/// are coupled at its neighbours alone. True where most rows reach each component, and nearly all
/// at nodes that they reach in their own one. Mistaken stretches do not.
bool couples_neighbours(const Sample& some) {
  const int components = some.numbering.components;
  std::vector<double> rows(components * components, 0.0);  // of a component that reach another one
  double all_rows = 0.0, nodes = 0.0, strays = 0.0;
  for (std::size_t k = 0; k < some.rows.size(); ++k) {
    const int mine = some.numbering.component(some.rows[k], some.n);
    const std::set<long long>& own = some.reached[k][mine];
    if (some.nodes_of(k).size() < 2) continue;  // a prescribed value
    ++all_rows;
    for (int c = 0; c < components; ++c) {
      const std::set<long long>& others = some.reached[k][c];
      rows[mine * components + c] += !others.empty();
      nodes += static_cast<double>(others.size());
      strays += static_cast<double>(std::count_if(
          others.begin(), others.end(), [&](long long node) { return own.count(node) == 0; }));
    }
  }
  rows = global_sum(*some.comm, rows);
  const auto counts = global_sum(*some.comm, std::vector{all_rows, nodes, strays});
  return counts[2] <= 0.05 * counts[1] && *std::min_element(rows.begin(), rows.end()) >
                                              0.5 * counts[0] / static_cast<double>(components);
}

}  // namespace

namespace {

/// The numbers of components to try, the likeliest first: as many nodes as scalars, if it may be.
std::vector<int> likely_components(long long n, long long n_scalars, int given) {
  if (given > 0) return {given};
  std::vector<int> all;
  for (const int components : {3, 2})
    if (n == components * n_scalars) all.push_back(components);
  if (n_scalars == 0) all.push_back(6);
  for (const int components : {3, 2})
    if (n != components * n_scalars) all.push_back(components);
  return all;
}

VectorOrder named(VectorOrder order) {
  order.text = std::to_string(order.components) + " components, " +
               (order.is_by_node ? "by node" : "by component");
  if (order.components == 1) order.text = "1 component";
  return order;
}

}  // namespace

VectorOrder find_components(const MatrixRows& A, long long n_scalars, int in_nodes,
                            const Teuchos::ParameterList& options) {
  const int given = options.get<int>("components");
  const auto& order = options.get<std::string>("order");
  const bool is_free = given == 0 && order == "automatic";
  VectorOrder best{given > 0 ? given : 1, order != "by component", ""};
  if (is_free && in_nodes > 0) return named({in_nodes, true, ""});
  double most = 0.9;  // near boundaries the components of a node differ
  for (const int components : likely_components(A.n_rows, n_scalars, given))
    for (const bool is_by_node : {true, false}) {
      if (components == 1 || A.n_rows % components != 0) continue;
      if (order != "automatic" && is_by_node != (order == "by node")) continue;
      const Numbering numbering{components, is_by_node};
      const Coupling coupling = coupling_of(A, numbering);
      const Sample some = sample(A, numbering);
      if (coupling == Coupling::of_others && !couples_neighbours(some)) continue;
      // The first of equals: lines of a grid of three nodes are as alike as components are.
      const double like = likeness(some) + (coupling == Coupling::none ? 0.05 : 0.0);
      if (like <= most + (most > 0.9 ? 0.02 : 0.0)) continue;
      most = like;
      best = {components, is_by_node, ""};
    }
  return named(best);
}

namespace {

double largest_of(const MatrixRows& K, std::size_t i) {
  double largest = 0.0;
  for (std::size_t k = K.start[i]; k < K.start[i + 1]; ++k)
    largest = std::max(largest, std::abs(K.values[k]));
  return largest;
}

/// How many columns beside those of scalars each row has, on all ranks.
std::vector<int> lengths_of_rows(const MatrixRows& K, const std::vector<char>& is_scalar) {
  std::vector<int> lengths;
  for (std::size_t i = 0; i < K.n_local_rows(); ++i) {
    const double least = rounding * largest_of(K, i);
    lengths.push_back(0);
    for (std::size_t k = K.start[i]; k < K.start[i + 1]; ++k)
      lengths.back() += is_scalar[K.columns[k]] == 0 && std::abs(K.values[k]) > least;
  }
  std::vector<long long> all(static_cast<std::size_t>(K.n_rows));
  std::iota(all.begin(), all.end(), 0LL);
  return fetch(*K.comm, all, lengths, K.n_rows);
}

/// The part of the nodes, up to 1, whose components have rows of the same length, if these are the
/// rows of vectors: for the best numbering. given: components, 0 for any.
double evenness(const std::vector<int>& lengths, const Stretch& vectors, int given) {
  constexpr long long most = 2000;  // nodes
  const long long n = vectors.last - vectors.first;
  double best = 0.0;
  for (const int components : {3, 2}) {
    if (n % components != 0 || n == 0 || (given > 0 && given != components)) continue;
    const long long nodes = n / components, step = nodes / most + 1;
    double of_node = 0.0, of_stretches = 0.0, count = 0.0;
    for (long long node = 0; node < nodes; node += step, ++count) {
      const int* row = &lengths[vectors.first + components * node];
      of_node += std::count(row, row + components, *row) == components;
      bool is_even = true;
      for (int c = 1; c < components; ++c)
        is_even =
            is_even && lengths[vectors.first + node] == lengths[vectors.first + c * nodes + node];
      of_stretches += is_even;
    }
    best = std::max(best, std::max(of_node, of_stretches) / count);
  }
  return best;
}

/// The block of these rows and columns without rounding.
MatrixRows block_of(const MatrixRows& K, const Stretch& vectors) {
  const auto is_in = [&](long long row) { return row >= vectors.first && row < vectors.last; };
  const long long n = vectors.last - vectors.first;
  RowCollector collector(n, n, K.comm);
  in_batches(K, [&](std::size_t first, std::size_t last) {
    std::vector<Entry> entries;
    for (std::size_t i = first; i < last; ++i) {
      const long long row = K.first_row() + static_cast<long long>(i);
      const double least = rounding * largest_of(K, i);
      for (std::size_t k = K.start[i]; k < K.start[i + 1]; ++k)
        if (is_in(row) && is_in(K.columns[k]) && std::abs(K.values[k]) > least)
          entries.push_back({row - vectors.first, K.columns[k] - vectors.first, K.values[k]});
    }
    collector.add(entries);
  });
  return collector.take();
}

}  // namespace

Stretch even_stretch(const MatrixRows& K, const std::vector<char>& is_scalar, Stretch vectors,
                     long long n_alone, const Teuchos::ParameterList& options) {
  constexpr long long most = 2000;  // so few are held
  if (n_alone == 0) return vectors;
  const int given = options.get<int>("components");
  const std::vector<int> lengths = lengths_of_rows(K, is_scalar);
  double most_even = std::max(0.9, evenness(lengths, vectors, given) + 0.02);
  const Stretch all = vectors;
  Stretch best = all;
  for (long long k = 1; k <= std::min(n_alone, most); ++k) {
    if (all.first == 0)
      --vectors.last;
    else
      ++vectors.first;
    const double even = evenness(lengths, vectors, given);
    if (even <= most_even) continue;
    most_even = even;
    best = vectors;
  }
  const long long n = best.last - best.first;
  if (n == all.last - all.first) return all;
  // Fluxes of a regular grid are as even.
  const VectorOrder order = find_components(block_of(K, best), K.n_rows - n, 0, options);
  return order.components > 1 ? best : all;
}

}  // namespace tunica::systems
