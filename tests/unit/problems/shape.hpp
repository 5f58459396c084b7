#pragma once
#include <algorithm>
#include <vector>

#include "tunica/assembly/element_geometry.hpp"
#include "tunica/base/reduce.hpp"

namespace tunica::test {

/// The least volume of an element over what it was. Collective.
inline double least_part_of_volume(const fields::FieldMesh& mesh, const std::vector<Vec3>& d) {
  std::vector<Vec3> moved(mesh.x);
  for (int a = 0; a < mesh.n_nodes(); ++a) moved[a] += d[a];
  const assembly::ElementGeometry before(mesh, mesh.x), after(mesh, moved);
  double least = 1e300;
  for (std::size_t e = 0; e < mesh.tets.size(); ++e)
    least = std::min(least, after[e].volume / before[e].volume);
  return global_min(*mesh.comm, least);
}

}  // namespace tunica::test
