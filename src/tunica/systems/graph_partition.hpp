#pragma once
#include <vector>

#include "tunica/systems/node_graph.hpp"

namespace tunica::systems {

/// METIS cuts graphs of up to so many edges, for which rank 0 has the whole: some 10 MB, a third of
/// what a process takes before it reads anything. It cuts as well as Zoltan in a twentieth of the
/// time.
constexpr long long most_edges_for_metis = 200000;

/// The rank of each node of the portion: parts of equal size, few edges between them. Larger graphs
/// are cut by Zoltan (PHG), which leaves them where they are. The same input on as many ranks gives
/// the same parts. Throws tunica::Error for more ranks than nodes. Collective.
std::vector<int> partition_graph(const NodeGraph& graph,
                                 long long most_edges = most_edges_for_metis);

/// The ranks of the portions of nodes and unknowns.
struct NodePartition {
  std::vector<int> vector_nodes, scalar_nodes;  ///< of each node
  std::vector<int> vectors, scalars;            ///< of each unknown
};

/// Splits the graph of the vector nodes. A scalar node goes with its vector node where they are
/// shared, otherwise to the rank that has most of its row of B2. Throws as partition_graph().
/// Collective.
NodePartition partition_nodes(const NodeGraph& vectors, const MatrixRows& B2,
                              const NodeTable& table);

}  // namespace tunica::systems
