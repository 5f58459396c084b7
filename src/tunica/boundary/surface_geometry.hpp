#pragma once
#include "tunica/fields/field_mesh.hpp"

namespace tunica::boundary {

/// How far the normals of a plane's triangles may be off their mean [rad]: a degree, for meshes
/// whose numbers are rounded.
constexpr double flat = 0.0174533;

/// Size and place of a surface of the undeformed mesh.
struct SurfaceGeometry {
  double area;
  Vec3 centre;    ///< centroid
  double radius;  ///< largest distance of a node from the centre
  Vec3 normal;    ///< out of the field, the mean of the triangles'; of length 1
  double bend;    ///< largest angle between it and that of a triangle [rad]
};

/// Area times normal, out of the field, that belongs to each owned node on one of the surfaces, a
/// third of each triangle around it; zero elsewhere [mm²]. positions: of the local nodes.
std::vector<Vec3> nodal_areas(const fields::FieldMesh& mesh, const std::vector<Vec3>& positions,
                              const std::vector<int>& surfaces);

/// Collective.
SurfaceGeometry surface_geometry(const fields::FieldMesh& mesh, int surface);

}  // namespace tunica::boundary
