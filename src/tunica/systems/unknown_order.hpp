#pragma once
#include <Teuchos_ParameterList.hpp>
#include <string>

#include "tunica/systems/matrix_rows.hpp"

namespace tunica::systems {

/// Components of the vector unknowns, and how they are numbered.
struct VectorOrder {
  int components = 1;
  bool is_by_node = true;
  std::string text;  ///< "3 components, by node"
};

/// From the keys "components" and "order" where they are given, otherwise from the pattern of A:
/// with the right numbers the rows of a node reach the same nodes, and either no component is
/// coupled with another one, or the components of a node or those of neighbours are. As many nodes
/// as scalars are likelier than others. in_nodes: ScalarRows::in_nodes, which leaves nothing to be
/// found. Collective.
VectorOrder find_components(const MatrixRows& A, long long n_scalars, int in_nodes,
                            const Teuchos::ParameterList& options);

}  // namespace tunica::systems
