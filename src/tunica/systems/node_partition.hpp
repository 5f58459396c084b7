#pragma once
#include "tunica/systems/node_graph.hpp"

namespace tunica::systems {

/// The rank of each vector and of each scalar node.
struct NodePartition {
  std::vector<int> vectors, scalars;
};

/// Splits the graph of the vector nodes by METIS. A scalar node goes with its vector node where
/// they are shared, otherwise to the rank that has most of its row of B2. The same input gives the
/// same parts. Throws tunica::Error for more ranks than nodes.
NodePartition partition_nodes(const NodeGraph& vectors, const FileMatrix& B2,
                              const NodeTable& table, int ranks);

}  // namespace tunica::systems
