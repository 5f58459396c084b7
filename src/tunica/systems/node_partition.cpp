#include "tunica/systems/node_partition.hpp"

#include <metis.h>

#include <algorithm>
#include <stdexcept>
#include <string>

#include "tunica/base/error.hpp"

namespace tunica::systems {

namespace {

std::vector<int> run_metis(const NodeGraph& graph, int ranks) {
  std::vector<idx_t> start{0}, neighbours, parts(graph.size());
  for (std::size_t i = 0; i < graph.size(); ++i) {
    for (const long long j : graph[i])
      if (j != static_cast<long long>(i)) neighbours.push_back(static_cast<idx_t>(j));
    start.push_back(static_cast<idx_t>(neighbours.size()));
  }
  idx_t options[METIS_NOPTIONS];
  METIS_SetDefaultOptions(options);
  options[METIS_OPTION_SEED] = 1;
  options[METIS_OPTION_NUMBERING] = 0;
  idx_t n = static_cast<idx_t>(graph.size()), constraints = 1, k = ranks, cut = 0;
  const int status =
      METIS_PartGraphKway(&n, &constraints, start.data(), neighbours.data(), nullptr, nullptr,
                          nullptr, &k, nullptr, nullptr, options, &cut, parts.data());
  if (status != METIS_OK)
    throw std::runtime_error("METIS failed with status " + std::to_string(status));
  return {parts.begin(), parts.end()};
}

int most_frequent(const std::vector<int>& counts) {
  return static_cast<int>(std::max_element(counts.begin(), counts.end()) - counts.begin());
}

}  // namespace

NodePartition partition_nodes(const NodeGraph& vectors, const FileMatrix& B2,
                              const NodeTable& table, int ranks) {
  TUNICA_CHECK(static_cast<std::size_t>(ranks) <= vectors.size(),
               "System: " + std::to_string(ranks) + " ranks for " + std::to_string(vectors.size()) +
                   " nodes. Use fewer ranks.");
  NodePartition partition;
  partition.vectors = ranks == 1 ? std::vector<int>(vectors.size(), 0) : run_metis(vectors, ranks);
  partition.scalars = partition.vectors;
  if (table.is_shared) return partition;
  for (long long i = 0; i < B2.n_rows; ++i) {
    std::vector<int> counts(ranks, 0);
    for (std::size_t k = B2.start[i]; k < B2.start[i + 1]; ++k)
      ++counts[partition.vectors[table.vector_node[B2.columns[k]]]];
    partition.scalars[table.scalar_node[i]] = most_frequent(counts);
  }
  return partition;
}

}  // namespace tunica::systems
