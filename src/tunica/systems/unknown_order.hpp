#pragma once
#include <Teuchos_ParameterList.hpp>
#include <string>
#include <vector>

#include "tunica/systems/matrix_rows.hpp"

namespace tunica::systems {

/// Files and sums leave this of an entry that is none.
constexpr double rounding = 1e-14;

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

/// Rows of K from first to last.
struct Stretch {
  long long first, last;
};

/// The rows of vectors that stand in front of scalars or behind them with rows between the two that
/// hold only their diagonal, n_alone of the last or first vectors: these are vectors, which have
/// prescribed values, but for those without which the vectors fall into components, such as a first
/// pressure that is held. Collective.
Stretch even_stretch(const MatrixRows& K, const std::vector<char>& is_scalar, Stretch vectors,
                     long long n_alone, const Teuchos::ParameterList& options);

}  // namespace tunica::systems
