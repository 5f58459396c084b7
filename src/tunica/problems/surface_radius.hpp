#pragma once
#include "tunica/fields/field_mesh.hpp"

namespace tunica::problems {

/// The radius of a vessel of which surfaces of its wall are the inside [mm]:
///
///   1/r = 1/A |∫ ∇_S·n dA|,      the mean curvature of a tube, with normals n at nodes
///
/// at most A^½, for surfaces that are flat. Needs no lumen, and no whole section. Collective.
double surface_radius(const fields::FieldMesh& mesh, const std::vector<int>& surfaces);

}  // namespace tunica::problems
