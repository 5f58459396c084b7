#pragma once
#include "tunica/mesh/wall/box_tree.hpp"
#include "tunica/mesh/wall/lumen_surface.hpp"

namespace tunica::mesh::wall {

/// The point of a triangle nearest to x.
Vec3 nearest_in_triangle(const Vec3& x, const std::array<Vec3, 3>& corners);

/// How far points are from a surface, in O(log n) each.
class SurfaceDistance {
public:
  struct Nearest {
    double distance;
    int triangle;
  };

  explicit SurfaceDistance(const LumenSurface& surface);

  /// The nearest triangle. A distance beyond which it is not looked for makes this faster; the
  /// triangle is -1 if there is none.
  Nearest nearest(const Vec3& x, double within) const;

private:
  const LumenSurface& surface_;
  BoxTree tree_;
};

}  // namespace tunica::mesh::wall
