#pragma once
#include "base/types.hpp"
#include "fields/field_mesh.hpp"

namespace tunica::fields {

/// Unknowns, residuals or increments of a field: a vector and a scalar per node.
struct BlockVector {
  Teuchos::RCP<Vector> u;  ///< velocity or displacement, 3*node + i
  Teuchos::RCP<Vector> p;  ///< pressure, node

  BlockVector() = default;
  /// Zero vectors.
  BlockVector(const Teuchos::RCP<const Map>& vector_map, const Teuchos::RCP<const Map>& scalar_map)
      : u(Teuchos::rcp(new Vector(vector_map))), p(Teuchos::rcp(new Vector(scalar_map))) {}
  explicit BlockVector(const FieldMesh& mesh) : BlockVector(mesh.vector_map, mesh.node_map) {}

  void assign(const BlockVector& other) {
    u->assign(*other.u);
    p->assign(*other.p);
  }
};

}  // namespace tunica::fields
