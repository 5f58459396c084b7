#pragma once
#include "tunica/systems/blocks.hpp"
#include "tunica/systems/node_table.hpp"

namespace tunica::systems {

/// Neighbours of each node, itself among them, ascending; a neighbour has the node as its own.
using NodeGraph = SparseRows;

/// Nodes that an entry of A couples; nodes without vector unknowns have none. Where vectors and
/// scalars share their nodes, an entry of any block does: beside fixed vectors, which A does not
/// couple, scalars are free. Collective.
NodeGraph vector_graph(const Blocks& blocks, const NodeTable& table);

/// Scalar nodes that are strongly coupled by C + B2 diag(A)⁻¹ B1ᵀ: entries of at least a tenth of
/// the geometric mean of both diagonals. Weak ones would make the graph wider than the
/// mesh. Collective.
NodeGraph scalar_graph(const Blocks& blocks, const NodeTable& table);

/// Which scalar stands at the node of a vector, where boundary conditions have left out vectors and
/// the numbers do not tell: its neighbours in C are those that the vector has in B1T. Not known
/// where two vectors claim one scalar. Collective.
ScalarsBeside scalars_beside(const Blocks& blocks, int components, bool is_by_node);

}  // namespace tunica::systems
