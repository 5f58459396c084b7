#pragma once
#include <array>
#include <vector>

#include "tunica/mesh/wall/lumen_surface.hpp"
#include "tunica/mesh/wall/thickness.hpp"
#include "tunica/mesh/wall/vertex_normals.hpp"

namespace tunica::mesh::wall {

/// The wall as it is going to be: where each vertex of the lumen's surface is carried to.
struct Plan {
  Plan(const LumenSurface& of, const std::vector<Layer>& layers, std::vector<double> wanted);

  const LumenSurface& surface;
  std::vector<double> heights;    ///< of the levels of vertices, 0 at the lumen, 1 outside
  std::vector<int> layer;         ///< between each level and the next
  std::vector<double> thickness;  ///< wanted at each vertex, mm
  Growth growth;
  std::vector<double> part;    ///< of the thickness that is left where it had to be limited
  std::vector<bool> is_dense;  ///< limited since other parts of the wall are close

  int steps() const { return static_cast<int>(layer.size()); }
  double left(int vertex) const { return part[vertex] * thickness[vertex]; }
  Vec3 place(int vertex, double height) const {
    return surface.x[vertex] +
           (height * left(vertex) * growth.stretch[vertex]) * growth.along[vertex];
  }
};

/// Vertices of the wall are numbered level by level: level * (vertices of the surface) + vertex.
/// A triangle's prism on this level as three tetrahedra. Diagonals of the sides rise from the
/// smaller number to the larger one, on odd levels the other way, so that neighbours match and the
/// mesh has no preferred direction of rotation.
std::array<std::array<int, 4>, 3> prism(const LumenSurface& surface, int triangle, int level);

/// The two triangles of a side of such a prism.
std::array<std::array<int, 3>, 2> side(const LumenSurface& surface, const std::array<int, 2>& edge,
                                       int level);

}  // namespace tunica::mesh::wall
