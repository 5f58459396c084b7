#pragma once
#include "tunica/fields/field_mesh.hpp"

namespace tunica::fields {

/// Location of a point in a field's undeformed mesh. A value there is the sum of those at the nodes
/// of a tetrahedron, each times its weight.
struct Place {
  bool is_here;                   ///< true on exactly one rank; nodes and weights hold there
  std::array<int, 4> nodes;       ///< local
  std::array<double, 4> weights;  ///< they add up to 1; at a vertex all but its own are zero
  double distance;                ///< of the point from the mesh; zero within it [mm]
  Vec3 position;                  ///< the point, or what is nearest to it of the mesh [mm]
  double element_length;          ///< longest edge of the tetrahedron [mm]

  template <class T>
  T value(const std::vector<T>& nodal) const {
    T sum{};
    for (int a = 0; a < 4; ++a) sum += weights[a] * nodal[nodes[a]];
    return sum;
  }
};

/// Locates a point on any number of ranks. Collective.
Place locate(const FieldMesh& mesh, const Vec3& point);

}  // namespace tunica::fields
