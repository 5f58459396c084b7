#include "tunica/mesh/wall/vertex_normals.hpp"

#include <algorithm>
#include <cmath>
#include <map>

#include "tunica/base/error.hpp"
#include "tunica/mesh/text.hpp"
#include "tunica/mesh/wall/local_radius.hpp"
#include "tunica/mesh/wall/surface_distance.hpp"

namespace tunica::mesh::wall {
namespace {

constexpr double least_visibility = 0.3;  ///< cosine; below it a direction is turned
constexpr double least_in_cap = 0.3;      ///< part of the normal in the plane of a cap
constexpr double most_stretch = 2.0;

/// An edge with the triangles on its sides; the second is -1 at a rim.
struct Edge {
  std::array<int, 2> ends;
  std::array<int, 2> triangles;
  double weight;  ///< cotangents of the angles opposite to it, none below zero
};

double cotangent(const Vec3& a, const Vec3& b) {
  return std::max(0.0, dot(a, b) / norm(cross(a, b)));
}

std::vector<Edge> edges(const LumenSurface& surface) {
  std::map<std::array<int, 2>, Edge> all;
  for (std::size_t t = 0; t < surface.triangles.size(); ++t)
    for (int k = 0; k < 3; ++k) {
      const auto& v = surface.triangles[t];
      const int a = v[k], b = v[(k + 1) % 3], apex = v[(k + 2) % 3];
      const std::array<int, 2> ends{std::min(a, b), std::max(a, b)};
      const auto [at, is_new] = all.insert({ends, {ends, {static_cast<int>(t), -1}, 0.0}});
      if (!is_new) at->second.triangles[1] = static_cast<int>(t);
      at->second.weight +=
          cotangent(surface.x[a] - surface.x[apex], surface.x[b] - surface.x[apex]);
    }
  std::vector<Edge> result;
  for (const auto& entry : all) result.push_back(entry.second);
  return result;
}

std::vector<Vec3> angle_weighted(const LumenSurface& surface) {
  std::vector<Vec3> normals(surface.x.size(), Vec3{});
  for (std::size_t t = 0; t < surface.triangles.size(); ++t) {
    const auto& v = surface.triangles[t];
    const Vec3 normal = surface.normal(static_cast<int>(t));
    for (int k = 0; k < 3; ++k) {
      const Vec3 a = surface.x[v[(k + 1) % 3]] - surface.x[v[k]];
      const Vec3 b = surface.x[v[(k + 2) % 3]] - surface.x[v[k]];
      normals[v[k]] += std::atan2(norm(cross(a, b)), dot(a, b)) * normal;
    }
  }
  for (std::size_t v = 0; v < normals.size(); ++v) {
    TUNICA_CHECK(norm(normals[v]) > 1e-6,
                 "wall: the surface is folded at " + show(surface.x[v]) +
                     ": its triangles have no common outside. Smooth the lumen there.");
    normals[v] = unit(normals[v]);
  }
  return normals;
}

/// Rounds of diffusion that reach three times as far as the wall is thick, but not so far beyond
/// the lumen's radius that the normals of a tube fall over to one of its ends, which are smoother
/// still. Half a round's weight is on neighbours an edge away: n rounds reach √n/2 edges.
int smoothing_rounds(const LumenSurface& surface, const std::vector<Edge>& all,
                     const std::vector<double>& thickness) {
  double length = 0.0, height = 0.0;
  for (const Edge& e : all)
    length += norm(surface.x[e.ends[1]] - surface.x[e.ends[0]]) / double(all.size());
  for (const double h : thickness) height += h / double(thickness.size());
  std::vector<double> radius = local_radius(surface);
  const auto narrow = radius.begin() + static_cast<std::ptrdiff_t>(radius.size() / 10);
  std::nth_element(radius.begin(), narrow, radius.end());
  const double reach = std::min(3.2 * height, 2.0 * *narrow) / length;
  return std::clamp(static_cast<int>(std::ceil(4.0 * reach * reach)), 3, 2000);
}

void smooth(const LumenSurface& surface, const std::vector<Edge>& all, std::vector<Vec3>& normals) {
  std::vector<Vec3> sum(normals.size(), Vec3{});
  std::vector<double> weight(normals.size(), 0.0);
  for (const Edge& e : all)
    for (int k = 0; k < 2; ++k) {
      sum[e.ends[k]] += e.weight * normals[e.ends[1 - k]];
      weight[e.ends[k]] += e.weight;
    }
  for (std::size_t v = 0; v < normals.size(); ++v) {
    if (weight[v] == 0.0) continue;
    const Vec3 mean =
        in_caps(surface, static_cast<int>(v), normals[v] + (1.0 / weight[v]) * sum[v]);
    if (norm(mean) > 1e-3) normals[v] = unit(mean);
  }
}

/// Turns the direction towards the normal that sees it least, until all see it well enough.
Vec3 turned_to_sight(const LumenSurface& surface, int vertex, Vec3 along) {
  const auto& list = surface.triangles_of;
  Vec3 best = along;
  double most = visibility(surface, vertex, along);
  for (int round = 0; round < 60 && most < least_visibility; ++round) {
    Vec3 worst{};
    double least = 2.0;
    for (int i = list.begin[vertex]; i < list.begin[vertex + 1]; ++i) {
      const Vec3 normal = surface.normal(list.items[i]);
      if (dot(along, normal) < least) {
        least = dot(along, normal);
        worst = normal;
      }
    }
    const Vec3 next = in_caps(surface, vertex, along + 0.3 * worst);
    if (norm(next) < 1e-3) break;
    along = unit(next);
    if (visibility(surface, vertex, along) <= most) continue;
    most = visibility(surface, vertex, along);
    best = along;
  }
  TUNICA_CHECK(most > 0.02, "wall: no direction leads out of the surface at " +
                                show(surface.x[vertex]) +
                                ": it is folded there. Smooth the lumen or mesh it finer there.");
  return best;
}

}  // namespace

double visibility(const LumenSurface& surface, int vertex, const Vec3& along) {
  const auto& list = surface.triangles_of;
  double least = 1.0;
  for (int i = list.begin[vertex]; i < list.begin[vertex + 1]; ++i)
    least = std::min(least, dot(along, surface.normal(list.items[i])));
  return least;
}

Vec3 in_caps(const LumenSurface& surface, int vertex, const Vec3& along) {
  const std::vector<Vec3>& planes = surface.planes_of[vertex];
  if (planes.empty()) return along;
  if (planes.size() == 1) return along - dot(along, planes[0]) * planes[0];
  const Vec3 line = unit(cross(planes[0], planes[1]));
  return dot(along, line) * line;
}

Growth growth_directions(const LumenSurface& surface, const std::vector<double>& thickness) {
  const std::vector<Edge> all = edges(surface);
  const std::vector<Vec3> normals = angle_weighted(surface);
  Growth growth{normals, std::vector<double>(normals.size(), 1.0)};
  for (std::size_t v = 0; v < normals.size(); ++v) {
    const Vec3 inside = in_caps(surface, static_cast<int>(v), normals[v]);
    TUNICA_CHECK(norm(inside) > least_in_cap,
                 "wall: at " + show(surface.x[v]) +
                     " the opening is nearly tangential to the surface, so that no wall ends in "
                     "its plane. Cut the vessel at a right angle there.");
    growth.along[v] = unit(inside);
  }
  for (int round = smoothing_rounds(surface, all, thickness); round > 0; --round)
    smooth(surface, all, growth.along);
  for (std::size_t v = 0; v < normals.size(); ++v) {
    growth.along[v] = turned_to_sight(surface, static_cast<int>(v), growth.along[v]);
    if (surface.planes_of[v].empty()) continue;
    const double inclined = std::max(dot(growth.along[v], normals[v]), 1.0 / most_stretch);
    growth.stretch[v] = 1.0 / inclined;
  }
  reach_thickness(surface, thickness, growth);
  return growth;
}

void reach_thickness(const LumenSurface& surface, const std::vector<double>& thickness,
                     Growth& growth) {
  const SurfaceDistance to_surface(surface);
  for (int v = 0; v < surface.vertices(); ++v)
    for (int round = 0; round < 12; ++round) {
      double& stretch = growth.stretch[v];
      const double length = stretch * thickness[v];
      const auto found = to_surface.nearest(surface.x[v] + length * growth.along[v], length);
      if (found.triangle < 0 || found.distance > 0.9999 * thickness[v]) break;
      if (dot(surface.normal(found.triangle), growth.along[v]) <= 0.0) break;
      stretch = std::min(most_stretch, stretch * thickness[v] / found.distance);
    }
}

}  // namespace tunica::mesh::wall
