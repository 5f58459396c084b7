#pragma once
#include "tunica/systems/matrix_rows.hpp"
#include "tunica/systems/node_table.hpp"

namespace tunica::systems {

/// Neighbours of each node, itself among them, ascending; a neighbour has the node as its own.
using NodeGraph = SparseRows;

/// Nodes that an entry of A couples; nodes without vector unknowns have none. Collective.
NodeGraph vector_graph(const MatrixRows& A, const NodeTable& table);

/// Scalar nodes that are strongly coupled by C + B2 diag(A)⁻¹ B1ᵀ: entries of at least a tenth of
/// the geometric mean of both diagonals. mC holds −C. Weak ones would make the graph wider than the
/// mesh. Collective.
NodeGraph scalar_graph(const MatrixRows& A, const MatrixRows& B1T, const MatrixRows& B2,
                       const MatrixRows& mC, const NodeTable& table);

}  // namespace tunica::systems
