#pragma once
#include "tunica/algebra/block_vector.hpp"
#include "tunica/assembly/element_geometry.hpp"

namespace tunica::assembly {

/// (xᵀ M x)^½ with the consistent P1 mass matrices of both blocks, on the nodes of these meshes, on
/// the given geometry. Collective.
double mass_norm(const fields::FieldMesh& mesh, const fields::FieldMesh& scalar_mesh,
                 const ElementGeometry& geometry, const algebra::BlockVector& x);
inline double mass_norm(const fields::FieldMesh& mesh, const ElementGeometry& geometry,
                        const algebra::BlockVector& x) {
  return mass_norm(mesh, mesh, geometry, x);
}

}  // namespace tunica::assembly
