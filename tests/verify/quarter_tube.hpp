#pragma once
#include <cmath>

#include "tunica/mesh/faces.hpp"
#include "tunica/mesh/tube.hpp"
#include "tunica/mesh/validate.hpp"

namespace tunica::verify {

/// Tags the boundary faces in x = 0 and y = 0 as "symmetry_x" and "symmetry_y".
inline void add_symmetry_planes(mesh::Mesh& quarter) {
  const int symmetry = static_cast<int>(quarter.surfaces.size());
  quarter.surfaces.push_back({21, "symmetry_x"});
  quarter.surfaces.push_back({22, "symmetry_y"});
  for (const mesh::Face& face : mesh::faces(quarter)) {
    const Vec3 c = mesh::centre(quarter, face.vertices);
    for (const int i : {0, 1})
      if (face.is_boundary() && std::abs(c[i]) < 1e-9) {
        quarter.triangles.push_back(face.vertices);
        quarter.triangle_surface.push_back(symmetry + i);
      }
  }
}

/// The quarter x ≥ 0, y ≥ 0 of a tube's wall: the regions and surfaces of mesh::make_tube and
/// the planes of symmetry "symmetry_x" (x = 0) and "symmetry_y" (y = 0).
inline mesh::Mesh quarter_of(const mesh::Mesh& tube) {
  mesh::Mesh quarter = tube;
  std::vector<int> number(tube.vertices.size(), -1);
  const auto is_inside = [&tube](const auto& corners) {
    Vec3 sum{};
    for (const int v : corners) sum += tube.vertices[v];
    return sum[0] > 0.0 && sum[1] > 0.0;
  };
  const auto renumber = [&](auto corners) {
    for (int& v : corners) {
      if (number[v] < 0) {
        number[v] = static_cast<int>(quarter.vertices.size());
        quarter.vertices.push_back(tube.vertices[v]);
      }
      v = number[v];
    }
    return corners;
  };
  quarter.vertices.clear();
  quarter.tets.clear();
  quarter.tet_region.clear();
  quarter.triangles.clear();
  quarter.triangle_surface.clear();
  for (std::size_t t = 0; t < tube.tets.size(); ++t)
    if (is_inside(tube.tets[t])) {
      quarter.tets.push_back(renumber(tube.tets[t]));
      quarter.tet_region.push_back(tube.tet_region[t]);
    }
  for (std::size_t t = 0; t < tube.triangles.size(); ++t)
    if (is_inside(tube.triangles[t])) {
      quarter.triangles.push_back(renumber(tube.triangles[t]));
      quarter.triangle_surface.push_back(tube.triangle_surface[t]);
    }
  add_symmetry_planes(quarter);
  mesh::validate(quarter, "quarter tube");
  return quarter;
}

/// One slice of the wall of mesh::Tube with 3n layers over the thickness and 8n cells over the
/// quarter circle; the slice is as thick as a layer.
inline mesh::Mesh make_quarter_tube(int n) {
  mesh::Tube tube;
  tube.with_lumen = false;
  tube.around = 32 * n;
  tube.media_layers = 2 * n;
  tube.adventitia_layers = n;
  tube.axial = 1;
  tube.length = 0.13 / n;
  return quarter_of(mesh::make_tube(tube));
}

}  // namespace tunica::verify
