#pragma once
#include "tunica/algebra/block_vector.hpp"
#include "tunica/fields/field_mesh.hpp"
#include "tunica/kernels/tet4.hpp"

namespace tunica::assembly {

/// (xᵀ M x)^½ with the consistent P1 mass matrices of both blocks, on the nodes of these meshes, on
/// the given geometry. Collective.
double mass_norm(const fields::FieldMesh& mesh, const fields::FieldMesh& scalar_mesh,
                 const std::vector<kernels::Tet4>& geometry, const algebra::BlockVector& x);
inline double mass_norm(const fields::FieldMesh& mesh, const std::vector<kernels::Tet4>& geometry,
                        const algebra::BlockVector& x) {
  return mass_norm(mesh, mesh, geometry, x);
}

/// Geometry of every local tetrahedron at the given positions of owned and ghost nodes.
std::vector<kernels::Tet4> geometry_of(const fields::FieldMesh& mesh, const std::vector<Vec3>& x);

}  // namespace tunica::assembly
