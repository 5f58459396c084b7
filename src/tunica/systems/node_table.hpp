#pragma once
#include <Teuchos_ParameterList.hpp>
#include <vector>

namespace tunica::systems {

/// Which node and component each unknown of a file belongs to.
struct NodeTable {
  int components = 0;
  std::vector<long long> vector_node, scalar_node;  ///< of each unknown
  std::vector<int> component;                       ///< of each vector unknown
  long long n_nodes = 0;                            ///< numbered without gaps
  /// Every node has a scalar and at least one vector unknown: both blocks share the nodes.
  bool is_shared = false;
};

/// From the options of read_system(). Throws tunica::Error where they do not fit the numbers of
/// unknowns.
NodeTable make_node_table(const Teuchos::ParameterList& options, long long n_vector,
                          long long n_scalar);

}  // namespace tunica::systems
