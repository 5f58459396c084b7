#pragma once
#include "tunica/systems/matrix_files.hpp"
#include "tunica/systems/node_table.hpp"

namespace tunica::systems {

/// Neighbours of each node, itself among them, ascending; a neighbour has the node as its own.
using NodeGraph = std::vector<std::vector<long long>>;

/// Nodes that an entry of A couples; nodes without vector unknowns have none.
NodeGraph vector_graph(const FileMatrix& A, const NodeTable& table);

/// Scalar nodes that are strongly coupled by C + B2 diag(A)⁻¹ B1ᵀ: entries of at least a tenth of
/// the geometric mean of both diagonals. mC holds −C. Weak ones would make the graph wider than the
/// mesh.
NodeGraph scalar_graph(const FileMatrix& A, const FileMatrix& B1T, const FileMatrix& B2,
                       const FileMatrix& mC, const NodeTable& table);

}  // namespace tunica::systems
