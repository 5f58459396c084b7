#pragma once
#include <string>
#include <vector>

#include "tunica/mesh/mesh.hpp"

namespace tunica::mesh {

/// Checks everything mesh.hpp promises: lengths and ranges of the arrays, unique tags, no
/// repeated vertices, no inverted or degenerate tetrahedra, no vertex without tetrahedron,
/// every boundary face covered by exactly one triangle. Triangles between tetrahedra are
/// permitted, at most one per face. Throws Error that begins with name and gives the place.
void validate(const Mesh& mesh, const std::string& name);

/// Checks that fluid and wall fit together: every triangle of the interface surfaces has one
/// fluid and one wall tetrahedron, every face between fluid and wall is such a triangle, and
/// fluid and wall share no other vertices. All arguments are names. Throws Error; an interface
/// of two meshes that do not share their vertices is named as such.
void check_interface(const Mesh& mesh, const std::vector<std::string>& fluid,
                     const std::vector<std::string>& wall,
                     const std::vector<std::string>& interface);

/// Index into mesh.regions. Throws Error that names the nearest valid name, or all.
int region_index(const Mesh& mesh, const std::string& name);

/// Index into mesh.surfaces. Throws Error that names the nearest valid name, or all.
int surface_index(const Mesh& mesh, const std::string& name);

}  // namespace tunica::mesh
