#pragma once
#include "tunica/base/types.hpp"

namespace tunica::algebra {

/// Unknowns, residuals or increments of a field: a vector and a scalar per node.
struct BlockVector {
  Teuchos::RCP<Vector> u;  ///< velocity or displacement, 3*node + i
  Teuchos::RCP<Vector> p;  ///< pressure, node

  BlockVector() = default;
  /// Zero vectors.
  BlockVector(const Teuchos::RCP<const Map>& vector_map, const Teuchos::RCP<const Map>& scalar_map)
      : u(Teuchos::rcp(new Vector(vector_map))), p(Teuchos::rcp(new Vector(scalar_map))) {}

  void assign(const BlockVector& other) {
    u->assign(*other.u);
    p->assign(*other.p);
  }
};

}  // namespace tunica::algebra
