#include "tunica/linear/direct/nested_dissection.hpp"

#include <metis.h>

#include <numeric>
#include <stdexcept>
#include <string>

namespace tunica::linear {

namespace {

struct Graph {
  std::vector<idx_t> starts, neighbours;
};

/// Of A + Aᵀ, without the diagonal; an edge may come twice.
Graph with_repeats(int n, const Entries& entries) {
  Graph graph{std::vector<idx_t>(n + 1, 0), {}};
  const std::size_t count = entries.rows.size();
  for (std::size_t k = 0; k < count; ++k) {
    if (entries.rows[k] == entries.columns[k]) continue;
    ++graph.starts[entries.rows[k]];
    ++graph.starts[entries.columns[k]];
  }
  std::partial_sum(graph.starts.begin(), graph.starts.end(), graph.starts.begin());
  graph.neighbours.resize(graph.starts.back());
  std::vector<idx_t> next(graph.starts.begin(), graph.starts.end() - 1);
  for (std::size_t k = 0; k < count; ++k) {
    const int i = entries.rows[k] - 1, j = entries.columns[k] - 1;
    if (i == j) continue;
    graph.neighbours[next[i]++] = j;
    graph.neighbours[next[j]++] = i;
  }
  return graph;
}

Graph simple_graph(int n, const Entries& entries) {
  Graph graph = with_repeats(n, entries);
  std::vector<int> seen_in(n, -1);
  idx_t end = 0;
  for (int i = 0, begin = 0; i < n; ++i) {
    const int next = graph.starts[i + 1];
    for (int k = begin; k < next; ++k) {
      const idx_t j = graph.neighbours[k];
      if (seen_in[j] == i) continue;
      seen_in[j] = i;
      graph.neighbours[end++] = j;
    }
    begin = next;
    graph.starts[i + 1] = end;
  }
  graph.neighbours.resize(end);
  return graph;
}

}  // namespace

std::vector<int> nested_dissection(int n, const Entries& entries) {
  Graph graph = simple_graph(n, entries);
  std::vector<idx_t> order(n), place(n);
  if (graph.neighbours.empty()) {  // METIS wants an edge
    std::iota(place.begin(), place.end(), 0);
    return {place.begin(), place.end()};
  }
  idx_t options[METIS_NOPTIONS];
  METIS_SetDefaultOptions(options);
  options[METIS_OPTION_SEED] = 1;
  options[METIS_OPTION_NUMBERING] = 0;
  options[METIS_OPTION_COMPRESS] = 1;
  idx_t size = n;
  const int status = METIS_NodeND(&size, graph.starts.data(), graph.neighbours.data(), nullptr,
                                  options, order.data(), place.data());
  if (status != METIS_OK)
    throw std::runtime_error("METIS failed with status " + std::to_string(status));
  return {place.begin(), place.end()};
}

}  // namespace tunica::linear
