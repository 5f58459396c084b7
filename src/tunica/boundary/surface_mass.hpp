#pragma once
#include "tunica/fields/field_mesh.hpp"

namespace tunica::boundary {

/// A density t on surfaces, linear on each triangle, of forces f on their nodes:
///
///   t = D⁻¹ M D⁻¹ f,   M_ab = ∫ N_a N_b da,   D_a = Σ_b M_ab
///
/// The force over the area around each node, averaged once over its triangles. Its integral is
/// the sum of the forces. M⁻¹ f would be exact where t is linear, but what meshes do to forces from
/// node to node it makes three times larger, and this ten times smaller.
///
/// positions: of the local nodes; force: on owned nodes; t is zero at nodes that do not lie on the
/// surfaces. Collective.
std::vector<Vec3> surface_density(const fields::FieldMesh& mesh, const std::vector<Vec3>& positions,
                                  const std::vector<int>& surfaces, const std::vector<Vec3>& force);

}  // namespace tunica::boundary
