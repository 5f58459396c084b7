#pragma once
#include "base/types.hpp"
#include "fields/field_mesh.hpp"

namespace tunica::fields {

/// Unknowns, residuals or increments of a field: a vector and a scalar per node.
struct BlockVector {
  Teuchos::RCP<Vector> u;  ///< velocity or displacement, 3*node + i
  Teuchos::RCP<Vector> p;  ///< pressure, node

  BlockVector() = default;
  /// Zero vectors on the field's maps.
  explicit BlockVector(const FieldMesh& mesh)
      : u(Teuchos::rcp(new Vector(mesh.vector_map))), p(Teuchos::rcp(new Vector(mesh.node_map))) {}

  void assign(const BlockVector& other) {
    u->assign(*other.u);
    p->assign(*other.p);
  }
};

}  // namespace tunica::fields
