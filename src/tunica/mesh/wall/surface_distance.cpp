#include "tunica/mesh/wall/surface_distance.hpp"

#include <algorithm>

namespace tunica::mesh::wall {
namespace {

std::vector<Box> boxes_of(const LumenSurface& surface) {
  std::vector<Box> boxes;
  for (const auto& v : surface.triangles)
    boxes.push_back(box_of({surface.x[v[0]], surface.x[v[1]], surface.x[v[2]]}));
  return boxes;
}

Vec3 nearest_in_segment(const Vec3& x, const Vec3& a, const Vec3& b) {
  const Vec3 d = b - a;
  return a + std::clamp(dot(x - a, d) / dot(d, d), 0.0, 1.0) * d;
}

}  // namespace

Vec3 nearest_in_triangle(const Vec3& x, const std::array<Vec3, 3>& corners) {
  const Vec3 normal = cross(corners[1] - corners[0], corners[2] - corners[0]);
  bool is_above = true;  // of the inside of the triangle
  for (int k = 0; k < 3; ++k) {
    const Vec3 edge = corners[(k + 1) % 3] - corners[k];
    is_above = is_above && dot(normal, cross(edge, x - corners[k])) >= 0.0;
  }
  if (is_above) return x - (dot(x - corners[0], normal) / dot(normal, normal)) * normal;
  Vec3 best = corners[0];
  for (int k = 0; k < 3; ++k) {
    const Vec3 point = nearest_in_segment(x, corners[k], corners[(k + 1) % 3]);
    if (norm(point - x) < norm(best - x)) best = point;
  }
  return best;
}

SurfaceDistance::SurfaceDistance(const LumenSurface& surface)
    : surface_(surface), tree_(boxes_of(surface)) {}

SurfaceDistance::Nearest SurfaceDistance::nearest(const Vec3& x, double within) const {
  Nearest found{within, -1};
  const auto may_reach = [&](const Box& box) {
    return box.distance2(x) <= found.distance * found.distance;
  };
  tree_.search(x, may_reach, [&](int t) {
    const auto& v = surface_.triangles[t];
    const Vec3 point =
        nearest_in_triangle(x, {surface_.x[v[0]], surface_.x[v[1]], surface_.x[v[2]]});
    const double distance = norm(point - x);
    if (distance <= found.distance) found = {distance, t};
  });
  return found;
}

}  // namespace tunica::mesh::wall
