#pragma once
#include <string>

#include "tunica/mesh/mesh.hpp"

namespace tunica::mesh {

/// Triangles in a plane z = const, and the curves that bound them or lie between them.
struct PlaneMesh {
  std::vector<Vec3> vertices;
  std::vector<std::array<int, 3>> triangles;
  std::vector<int> triangle_region;  ///< per triangle: index into regions
  std::vector<std::array<int, 2>> lines;
  std::vector<int> line_curve;  ///< per line: index into curves
  std::vector<Tag> regions, curves;
};

/// Reads triangles of a Gmsh file, by physical surfaces, and lines, by physical curves. Throws
/// Error where they do not lie in a plane z = const.
PlaneMesh read_plane_mesh(const std::string& path);

/// The plane drawn out along z to a slab one cell thick, three tetrahedra for each triangle.
/// Regions keep their names, and curves give theirs to the surfaces above them; "back" is where the
/// plane lies, "front" a thickness above it [mm]. Throws Error, beginning with name, where an edge
/// at the boundary or between regions belongs to no curve. The mesh passes validate().
Mesh drawn_out(const PlaneMesh& plane, double thickness, const std::string& name);

/// The mean length of the edges of its triangles [mm].
double mean_edge(const PlaneMesh& plane);

}  // namespace tunica::mesh
