#include "tunica/mesh/wall/local_radius.hpp"

#include <algorithm>
#include <cmath>

#include "tunica/mesh/wall/box_tree.hpp"

namespace tunica::mesh::wall {
namespace {

constexpr double least_height = 0.5;  ///< sine of 30 degrees

std::vector<Vec3> normals(const LumenSurface& surface) {
  std::vector<Vec3> sum(surface.x.size(), Vec3{});
  for (std::size_t t = 0; t < surface.triangles.size(); ++t)
    for (const int v : surface.triangles[t]) sum[v] += surface.area_vector(static_cast<int>(t));
  for (std::size_t v = 0; v < sum.size(); ++v) {
    // At an opening triangles are on one side only: its plane knows better.
    for (const Vec3& plane : surface.planes_of[v]) sum[v] = sum[v] - dot(sum[v], plane) * plane;
    if (norm(sum[v]) > 0.0) sum[v] = unit(sum[v]);
  }
  return sum;
}

/// Radius of the ball that touches at x and goes through the nearest of all other vertices.
double ball(const BoxTree& tree, const std::vector<Vec3>& all, int vertex, const Vec3& inward,
            double radius) {
  const Vec3& x = all[vertex];
  const auto may_reach = [&](const Box& box) {
    return box.distance2(x + radius * inward) < radius * radius;
  };
  tree.search(x, may_reach, [&](int other) {
    const Vec3 d = all[other] - x;
    const double height = dot(d, inward);
    if (other == vertex || height < least_height * norm(d) || height <= 0.0) return;
    radius = std::min(radius, 0.5 * dot(d, d) / height);
  });
  return radius;
}

/// One value per vertex out of its own and its neighbours'.
template <typename Rule>
std::vector<double> from_neighbours(const LumenSurface& surface, const std::vector<double>& values,
                                    const Rule& rule) {
  std::vector<double> result;
  const Lists& list = surface.neighbours_of;
  for (int v = 0; v < surface.vertices(); ++v) {
    std::vector<double> seen{values[v]};
    for (int i = list.begin[v]; i < list.begin[v + 1]; ++i) seen.push_back(values[list.items[i]]);
    result.push_back(rule(seen));
  }
  return result;
}

double median(std::vector<double>& values) {
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

double mean(const std::vector<double>& values) {
  double sum = 0.0;
  for (const double value : values) sum += value;
  return sum / double(values.size());
}

}  // namespace

std::vector<double> local_radius(const LumenSurface& surface) {
  std::vector<Box> points;
  for (const Vec3& x : surface.x) points.push_back({x, x});
  const BoxTree tree(points);
  const Box all = box_of(surface.x);
  const std::vector<Vec3> outward = normals(surface);
  std::vector<double> radius;
  for (int v = 0; v < surface.vertices(); ++v)
    radius.push_back(ball(tree, surface.x, v, -1.0 * outward[v], 0.5 * norm(all.high - all.low)));
  radius = from_neighbours(surface, radius, median);
  for (int round = 0; round < 3; ++round) radius = from_neighbours(surface, radius, mean);
  return radius;
}

}  // namespace tunica::mesh::wall
