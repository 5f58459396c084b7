#pragma once
#include "fields/field_mesh.hpp"

namespace tunica::problems {

/// Size and place of a surface of the undeformed mesh.
struct SurfaceGeometry {
  double area;
  Vec3 centre;    ///< centroid
  double radius;  ///< largest distance of a node from the centre
};

/// Collective.
SurfaceGeometry surface_geometry(const fields::FieldMesh& mesh, int surface);

}  // namespace tunica::problems
