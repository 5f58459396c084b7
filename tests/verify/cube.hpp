#pragma once
#include "tunica/mesh/block.hpp"

namespace tunica::verify {

/// The unit cube of n³ cells, six tetrahedra each; one region "fluid", one surface "boundary".
inline mesh::Mesh make_cube(int n) {
  mesh::Mesh mesh = mesh::make_block({{1.0, 1.0, 1.0}, {n, n, n}, {0, 0}});
  mesh.regions = {{1, "fluid"}};
  mesh.surfaces = {{1, "boundary"}};
  mesh.triangle_surface.assign(mesh.triangles.size(), 0);
  return mesh;
}

}  // namespace tunica::verify
