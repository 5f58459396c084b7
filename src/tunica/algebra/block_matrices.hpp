#pragma once
#include "tunica/algebra/block_vector.hpp"

namespace tunica::algebra {

/// Nodes as multigrid sees them.
struct Nodes {
  Teuchos::RCP<const CrsMatrix> graph;  ///< a row per node, its neighbours and itself
  Teuchos::RCP<const Vector> order;     ///< in which nodes are picked; the same on any ranks
};

/// A 2×2 block system, whoever assembled it:
///
///   K = [ A   B1ᵀ ]
///       [ B2  −C  ]
///
/// mC holds −C. Rows of A are components*node + i, rows of mC node. A vector node may lack some
/// components, and vector and scalar nodes may be different ones: each kind has its own numbers.
struct BlockMatrices {
  Teuchos::RCP<CrsMatrix> A, B1T, B2, mC;
  int components = 3;      ///< of the vector unknowns
  Nodes vectors, scalars;  ///< the same graph where the nodes are the same

  Teuchos::RCP<const Map> vector_map() const { return A->getRowMap(); }
  Teuchos::RCP<const Map> scalar_map() const { return mC->getRowMap(); }
  CommPtr comm() const { return A->getComm(); }
  long long n_unknowns() const {
    return static_cast<long long>(A->getGlobalNumRows() + mC->getGlobalNumRows());
  }
  BlockVector zero() const { return {vector_map(), scalar_map()}; }

  /// y = K x.
  void apply(const BlockVector& x, BlockVector& y) const;
};

}  // namespace tunica::algebra
