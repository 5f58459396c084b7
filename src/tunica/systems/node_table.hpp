#pragma once
#include <Teuchos_ParameterList.hpp>
#include <vector>

#include "tunica/systems/matrix_rows.hpp"

namespace tunica::systems {

/// Which node and component each unknown of a file belongs to: the portions of the vector and of
/// the scalar unknowns that a rank has.
struct NodeTable {
  int components = 0;
  std::vector<long long> vector_node, scalar_node;  ///< of each unknown
  std::vector<int> component;                       ///< of each vector unknown
  long long n_nodes = 0;                            ///< of all ranks, numbered without gaps
  /// Every node has a scalar and at least one vector unknown, but for scalars of the border, or
  /// those found beside vectors of which others are left out: both blocks share the nodes.
  bool is_shared = false;
};

/// The scalar that stands at each node of the vectors, where it is found and not given.
struct ScalarsBeside {
  bool are_known = false;
  std::vector<long long> of_node;  ///< of the rank's portion of the nodes
};

/// From the options of read_system(), of which rank 0 reads the file, some lines at once. n_border:
/// scalars that border the system. beside: instead of the order in which both are numbered. Throws
/// tunica::Error on all ranks where they do not fit the numbers of unknowns. Collective.
NodeTable make_node_table(const Teuchos::ParameterList& options, long long n_vector,
                          long long n_scalar, long long n_border, const ScalarsBeside& beside,
                          const CommPtr& comm, std::size_t lines_at_once = entries_at_once);

}  // namespace tunica::systems
