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

}  // namespace tunica::systems
