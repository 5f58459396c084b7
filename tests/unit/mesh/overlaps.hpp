#pragma once
#include <algorithm>

#include "tunica/mesh/faces.hpp"

namespace tunica::mesh {

/// How many vertices lie within a tetrahedron that they do not belong to. Every pair is tried.
inline int count_overlaps(const Mesh& mesh) {
  int overlaps = 0;
  for (int t = 0; t < static_cast<int>(mesh.tets.size()); ++t) {
    const auto c = corners(mesh, t);
    Vec3 low = c[0], high = c[0];
    for (const Vec3& x : c)
      for (int i = 0; i < 3; ++i) {
        low[i] = std::min(low[i], x[i]);
        high[i] = std::max(high[i], x[i]);
      }
    const double least = 1e-9 * volume(mesh, t);
    for (const Vec3& x : mesh.vertices) {
      if (x[0] <= low[0] || x[0] >= high[0] || x[1] <= low[1] || x[1] >= high[1] ||
          x[2] <= low[2] || x[2] >= high[2])
        continue;
      const bool is_inside = signed_volume(x, c[1], c[2], c[3]) > least &&
                             signed_volume(c[0], x, c[2], c[3]) > least &&
                             signed_volume(c[0], c[1], x, c[3]) > least &&
                             signed_volume(c[0], c[1], c[2], x) > least;
      overlaps += is_inside ? 1 : 0;
    }
  }
  return overlaps;
}

}  // namespace tunica::mesh
