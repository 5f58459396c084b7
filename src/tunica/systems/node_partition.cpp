#include "tunica/systems/node_partition.hpp"

#include <algorithm>

#include "tunica/base/sort_once.hpp"
#include "tunica/systems/graph_partition.hpp"

namespace tunica::systems {

namespace {

int most_frequent(const std::vector<int>& counts) {
  return static_cast<int>(std::max_element(counts.begin(), counts.end()) - counts.begin());
}

/// Of unknowns that go with their nodes.
std::vector<int> ranks_of(const std::vector<long long>& node_of_unknown,
                          const std::vector<int>& rank_of_node, const NodeGraph& graph) {
  std::vector<long long> nodes = node_of_unknown;
  sort_once(nodes);
  const Fetched<int> rank_of(*graph.comm, std::move(nodes), rank_of_node, graph.n_rows);
  std::vector<int> ranks;
  for (const long long node : node_of_unknown) ranks.push_back(rank_of(node));
  return ranks;
}

/// Where most of their rows of B2 are.
std::vector<int> ranks_by_rows(const MatrixRows& B2, const std::vector<int>& rank_of_vectors) {
  const Fetched<int> rank_of(*B2.comm, columns_of(B2), rank_of_vectors, B2.n_columns);
  std::vector<int> ranks;
  for (std::size_t i = 0; i < B2.n_local_rows(); ++i) {
    std::vector<int> counts(B2.comm->getSize(), 0);
    for (std::size_t k = B2.start[i]; k < B2.start[i + 1]; ++k) ++counts[rank_of(B2.columns[k])];
    ranks.push_back(most_frequent(counts));
  }
  return ranks;
}

/// Of nodes that go with their one unknown; 0 of those without.
std::vector<int> ranks_of_nodes(const std::vector<long long>& node_of_unknown,
                                const std::vector<int>& rank_of_unknown, const NodeGraph& graph) {
  struct Node {
    long long number;
    int rank;
  };
  std::vector<Node> nodes;
  std::vector<int> to;
  for (std::size_t i = 0; i < node_of_unknown.size(); ++i) {
    nodes.push_back({node_of_unknown[i], rank_of_unknown[i]});
    to.push_back(rank_of_row(node_of_unknown[i], graph.n_rows, *graph.comm));
  }
  std::vector<int> ranks(graph.n_local_rows(), 0);
  for (const Node& node : exchange_to(*graph.comm, nodes, to).items)
    ranks[node.number - graph.first_row()] = node.rank;
  return ranks;
}

}  // namespace

NodePartition partition_nodes(const NodeGraph& vectors, const MatrixRows& B2,
                              const NodeTable& table) {
  NodePartition partition;
  partition.vector_nodes = partition_graph(vectors);
  partition.vectors = ranks_of(table.vector_node, partition.vector_nodes, vectors);
  if (table.is_shared) {
    partition.scalar_nodes = partition.vector_nodes;
    partition.scalars = ranks_of(table.scalar_node, partition.vector_nodes, vectors);
  } else {
    partition.scalars = ranks_by_rows(B2, partition.vectors);
    partition.scalar_nodes = ranks_of_nodes(table.scalar_node, partition.scalars, vectors);
  }
  return partition;
}

}  // namespace tunica::systems
