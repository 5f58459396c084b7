#include "tunica/fields/simplex.hpp"

namespace tunica::fields {

namespace {

std::array<double, 3> nearest_on_edges(const std::array<Vec3, 3>& x, const Vec3& point) {
  std::array<double, 3> best{};
  double smallest = 1e300;
  for (int a = 0; a < 3; ++a) {
    const int b = (a + 1) % 3;
    const Vec3 edge = x[b] - x[a];
    const double t = std::clamp(dot(point - x[a], edge) / dot(edge, edge), 0.0, 1.0);
    std::array<double, 3> weights{};
    weights[a] = 1.0 - t;
    weights[b] = t;
    if (const double r = norm(point - point_of(weights, x)); r < smallest) {
      smallest = r;
      best = weights;
    }
  }
  return best;
}

}  // namespace

std::array<double, 3> nearest_on(const std::array<Vec3, 3>& x, const Vec3& point) {
  const Vec3 n = cross(x[1] - x[0], x[2] - x[0]);
  std::array<double, 3> weights;  // of the foot of the perpendicular
  for (int a = 0; a < 3; ++a)
    weights[a] = dot(n, cross(x[(a + 2) % 3] - x[(a + 1) % 3], point - x[(a + 1) % 3])) / dot(n, n);
  for (const double w : weights)
    if (!(w >= 0.0)) return nearest_on_edges(x, point);
  return weights;
}

// Out of the tetrahedron the nearest point lies on one of the sides that the point is behind.
std::array<double, 4> nearest_in(const std::array<Vec3, 4>& x, const Vec3& point) {
  const std::array<double, 4> weights = weights_in(x, point);
  if (is_inside(weights)) return weights;
  std::array<double, 4> best{};
  double smallest = 1e300;
  for (int a = 0; a < 4; ++a) {
    if (weights[a] >= 0.0) continue;
    const int b = (a + 1) % 4, c = (a + 2) % 4, d = (a + 3) % 4;
    const std::array<Vec3, 3> side{x[b], x[c], x[d]};
    const std::array<double, 3> w = nearest_on(side, point);
    if (const double r = norm(point - point_of(w, side)); r < smallest) {
      smallest = r;
      best = {};
      best[b] = w[0];
      best[c] = w[1];
      best[d] = w[2];
    }
  }
  return best;
}

}  // namespace tunica::fields
