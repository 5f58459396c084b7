#pragma once
#include <algorithm>

#include "tunica/mesh/faces.hpp"
#include "tunica/mesh/mesh.hpp"
#include "tunica/mesh/validate.hpp"

namespace tunica::verify {

/// The unit cube of n³ cells, six tetrahedra each (Kuhn); one region, one surface "boundary".
inline mesh::Mesh make_cube(int n) {
  mesh::Mesh mesh;
  mesh.regions = {{1, "fluid"}};
  mesh.surfaces = {{1, "boundary"}};
  const auto index = [n](int i, int j, int k) { return (k * (n + 1) + j) * (n + 1) + i; };
  for (int k = 0; k <= n; ++k)
    for (int j = 0; j <= n; ++j)
      for (int i = 0; i <= n; ++i)
        mesh.vertices.push_back({double(i) / n, double(j) / n, double(k) / n});
  std::array<int, 3> path{0, 1, 2};
  do {  // from corner to corner of a cell, along the axes in each order
    for (int cell = 0; cell < n * n * n; ++cell) {
      std::array<int, 3> at{cell % n, cell / n % n, cell / n / n};
      std::array<int, 4> tet{index(at[0], at[1], at[2]), 0, 0, 0};
      for (int s = 0; s < 3; ++s) {
        ++at[path[s]];
        tet[s + 1] = index(at[0], at[1], at[2]);
      }
      mesh.tets.push_back(tet);
      if (mesh::volume(mesh, static_cast<int>(mesh.tets.size()) - 1) < 0.0)
        std::swap(mesh.tets.back()[2], mesh.tets.back()[3]);
    }
  } while (std::next_permutation(path.begin(), path.end()));
  mesh.tet_region.assign(mesh.tets.size(), 0);
  for (const mesh::Face& face : mesh::faces(mesh))
    if (face.is_boundary()) mesh.triangles.push_back(face.vertices);
  mesh.triangle_surface.assign(mesh.triangles.size(), 0);
  mesh::validate(mesh, "cube");
  return mesh;
}

}  // namespace tunica::verify
