#pragma once
#include "tunica/systems/node_graph.hpp"

namespace tunica::systems {

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
