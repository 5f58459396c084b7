#pragma once
#include <map>
#include <vector>

#include "base/types.hpp"

namespace tunica::multigrid {

/// Coarser and coarser sets of nodes, picked from a graph of nodes [Ki98]: a maximal
/// independent set becomes the next level, and every other node takes the mean of its
/// neighbours in it. All blocks of a field share the nodes, so that each level keeps the
/// pairing of one pressure and three vector components. Depends on the graph alone: made once
/// per solver, level by level as they are asked for.
class NodalCoarsening {
public:
  /// nodes: square, with one row per node and an entry on the diagonal; its values are ignored.
  /// The rows of each rank have contiguous numbers.
  explicit NodalCoarsening(const Teuchos::RCP<const CrsMatrix>& nodes);

  /// Interpolation from level + 1 to level (0 the finest) for `dofs` unknowns per node numbered
  /// dofs*node + i. Its rows sum to one. Collective where it is asked for the first time.
  Teuchos::RCP<const CrsMatrix> prolongator(int level, int dofs);

  /// Nodes of all ranks on a level. Collective as prolongator() is.
  long long n_nodes(int level);

private:
  void add_level();

  std::vector<Teuchos::RCP<const CrsMatrix>> graphs_;
  std::vector<std::map<int, Teuchos::RCP<const CrsMatrix>>> prolongators_;  ///< by dofs per node
};

}  // namespace tunica::multigrid
