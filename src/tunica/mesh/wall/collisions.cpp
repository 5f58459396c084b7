#include "tunica/mesh/wall/collisions.hpp"

#include <algorithm>
#include <cmath>

#include "tunica/base/sort_once.hpp"
#include "tunica/mesh/wall/box_tree.hpp"

namespace tunica::mesh::wall {
namespace {

constexpr double clear_part = 0.8;  ///< of the free distance that opposite walls may take
constexpr double margin = 1.1;      ///< of the thickness that must not cross anything

/// Where the ray from a place along d passes through the triangle, in lengths of d; negative if it
/// does not.
double hit(const Vec3& from, const Vec3& d, const Corners& c) {
  const Vec3 normal = cross(c[1] - c[0], c[2] - c[0]);
  const double speed = dot(normal, d);
  if (speed == 0.0) return -1.0;
  const double at = dot(normal, c[0] - from) / speed;
  const Vec3 point = from + at * d;
  for (int k = 0; k < 3; ++k) {
    const Vec3 edge = c[(k + 1) % 3] - c[k];
    if (dot(normal, cross(edge, point - c[k])) < 0.0) return -1.0;
  }
  return at;
}

bool crosses(const Corners& a, const Corners& b) {
  for (int k = 0; k < 3; ++k) {
    const double at = hit(a[k], a[(k + 1) % 3] - a[k], b);
    if (at >= 0.0 && at <= 1.0) return true;
  }
  return false;
}

bool passes(const Box& box, const Vec3& from, const Vec3& d, double length) {
  double enter = 0.0, leave = length;
  for (int i = 0; i < 3; ++i) {
    if (d[i] == 0.0) {
      if (from[i] < box.low[i] || from[i] > box.high[i]) return false;
      continue;
    }
    const double a = (box.low[i] - from[i]) / d[i], b = (box.high[i] - from[i]) / d[i];
    enter = std::max(enter, std::min(a, b));
    leave = std::min(leave, std::max(a, b));
  }
  return enter <= leave;
}

Box box_of_triangle(const Corners& c) {
  Box box{c[0], c[0]};
  box.add(c[1]);
  box.add(c[2]);
  return box;
}

BoxTree tree_of(const std::vector<Corners>& triangles) {
  std::vector<Box> boxes;
  for (const Corners& c : triangles) boxes.push_back(box_of_triangle(c));
  return BoxTree(boxes);
}

/// Of the surface's triangles, carried outwards to this height.
std::vector<Corners> carried(const Plan& plan, double height) {
  std::vector<Corners> result;
  for (const auto& v : plan.surface.triangles)
    result.push_back(
        {plan.place(v[0], height), plan.place(v[1], height), plan.place(v[2], height)});
  return result;
}

bool have_common_vertex(const std::array<int, 3>& a, const std::array<int, 3>& b) {
  return std::any_of(a.begin(), a.end(),
                     [&](int v) { return std::find(b.begin(), b.end(), v) != b.end(); });
}

/// The nearest triangle that the ray meets from outside, and how far it is.
struct Opposite {
  int triangle = -1;
  double distance;
};

Opposite opposite(const Plan& plan, const BoxTree& tree, const std::vector<Corners>& all,
                  int vertex, double reach) {
  const Vec3& x = plan.surface.x[vertex];
  const Vec3& along = plan.growth.along[vertex];
  Opposite nearest{-1, reach};
  tree.search(
      x, [&](const Box& box) { return passes(box, x, along, nearest.distance); },
      [&](int t) {
        const auto& v = plan.surface.triangles[t];
        if (std::find(v.begin(), v.end(), vertex) != v.end()) return;
        if (dot(plan.surface.area_vector(t), along) >= 0.0) return;
        const double at = hit(x, along, all[t]);
        if (at >= 0.0 && at < nearest.distance) nearest = {t, at};
      });
  return nearest;
}

}  // namespace

void keep_clear_of_opposite(Plan& plan) {
  const std::vector<Corners> all = carried(plan, 0.0);
  const BoxTree tree = tree_of(all);
  std::vector<double> length(plan.part.size());
  for (std::size_t v = 0; v < length.size(); ++v)
    length[v] = plan.thickness[v] * plan.growth.stretch[v];
  const double most = *std::max_element(length.begin(), length.end());
  for (int v = 0; v < plan.surface.vertices(); ++v) {
    const Opposite found = opposite(plan, tree, all, v, (length[v] + most) / clear_part);
    if (found.triangle < 0) continue;
    double other = 0.0;  // what grows towards us
    for (const int w : plan.surface.triangles[found.triangle])
      other = std::max(other, -length[w] * dot(plan.growth.along[w], plan.growth.along[v]));
    if (length[v] + other <= clear_part * found.distance) continue;
    plan.part[v] = std::min(plan.part[v], clear_part * found.distance / (length[v] + other));
    plan.is_dense[v] = true;
  }
}

std::vector<int> crossing_triangles(const Plan& plan, const std::vector<Corners>& obstacles) {
  std::vector<Corners> all = carried(plan, margin);
  const int outer = static_cast<int>(all.size());
  all.insert(all.end(), obstacles.begin(), obstacles.end());
  const BoxTree tree = tree_of(all);
  std::vector<int> crossing;
  for (int t = 0; t < outer; ++t) {
    const Box box = box_of_triangle(all[t]);
    tree.search(
        all[t][0], [&](const Box& other) { return box.overlaps(other); },
        [&](int other) {
          if (other <= t || !box.overlaps(box_of_triangle(all[other]))) return;
          if (other < outer &&
              have_common_vertex(plan.surface.triangles[t], plan.surface.triangles[other]))
            return;
          if (!crosses(all[t], all[other]) && !crosses(all[other], all[t])) return;
          crossing.push_back(t);
          if (other < outer) crossing.push_back(other);
        });
  }
  sort_once(crossing);
  return crossing;
}

}  // namespace tunica::mesh::wall
