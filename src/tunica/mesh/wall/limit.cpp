#include "tunica/mesh/wall/limit.hpp"

#include <algorithm>
#include <queue>

#include "tunica/base/error.hpp"
#include "tunica/base/sort_once.hpp"
#include "tunica/mesh/text.hpp"

namespace tunica::mesh::wall {
namespace {

constexpr double wanted_volume = 1.0 / 6.0;  ///< of an element, over its share of the prism
constexpr double even_volume = 0.5;          ///< below it directions are turned, no more
constexpr int most_rounds = 200;
constexpr int spreading_rounds = 20;
constexpr int turning_rounds = 10;  ///< before the thickness is taken back
constexpr double step_back = 6.0 / 7.0;
constexpr double least_part = 0.05;
constexpr double steepest = 0.3;  ///< growth of the thickness with the distance from a limit
constexpr double least_sight = 0.25;

/// What can be wanted where the surface itself is so rough that the thinnest wall would not have
/// it.
double reachable_volume(const Plan& plan, int triangle) {
  double sight = 1.0;
  for (const int v : plan.surface.triangles[triangle])
    sight = std::min(sight, dot(plan.growth.along[v], plan.surface.normal(triangle)));
  return std::min(wanted_volume, 0.5 * sight);
}

std::vector<int> folded_triangles(const Plan& plan) {
  std::vector<int> folded;
  for (int t = 0; t < static_cast<int>(plan.surface.triangles.size()); ++t)
    if (least_volume_part(plan, t) < reachable_volume(plan, t)) folded.push_back(t);
  return folded;
}

std::vector<int> squeezed_triangles(const Plan& plan) {
  std::vector<int> squeezed;
  for (int t = 0; t < static_cast<int>(plan.surface.triangles.size()); ++t)
    if (least_volume_part(plan, t) < even_volume) squeezed.push_back(t);
  return squeezed;
}

std::vector<int> vertices_of(const Plan& plan, const std::vector<int>& triangles) {
  std::vector<int> result;
  for (const int t : triangles)
    for (const int v : plan.surface.triangles[t]) result.push_back(v);
  sort_once(result);
  return result;
}

/// Halfway towards the mean of the neighbours, unless its triangles would lose sight of it.
void turn(Plan& plan, const std::vector<int>& vertices) {
  const LumenSurface& surface = plan.surface;
  const std::vector<Vec3> before = plan.growth.along;
  for (const int v : vertices) {
    const int begin = surface.neighbours_of.begin[v], end = surface.neighbours_of.begin[v + 1];
    Vec3 mean{};
    for (int i = begin; i < end; ++i)
      mean += (1.0 / (end - begin)) * before[surface.neighbours_of.items[i]];
    const Vec3 next = in_caps(surface, v, before[v] + mean);
    if (norm(next) < 0.1) continue;
    const double sight = std::min(least_sight, visibility(surface, v, before[v]));
    if (visibility(surface, v, unit(next)) >= sight) plan.growth.along[v] = unit(next);
  }
}

/// Turns apart what squeezes elements between them.
void spread_directions(Plan& plan) {
  for (int round = 0; round < spreading_rounds; ++round) {
    const std::vector<int> squeezed = squeezed_triangles(plan);
    if (squeezed.empty()) return;
    turn(plan, vertices_of(plan, squeezed));
    if (round % 10 == 9) reach_thickness(plan.surface, plan.thickness, plan.growth);
  }
}

/// Dijkstra's algorithm: no vertex has more than its neighbour and the slope permit.
void spread(Plan& plan) {
  using Entry = std::pair<double, int>;
  std::priority_queue<Entry, std::vector<Entry>, std::greater<>> waiting;
  const LumenSurface& surface = plan.surface;
  for (int v = 0; v < surface.vertices(); ++v)
    if (plan.part[v] < 1.0) waiting.push({plan.part[v], v});
  while (!waiting.empty()) {
    const auto [part, v] = waiting.top();
    waiting.pop();
    if (part > plan.part[v]) continue;
    for (int i = surface.neighbours_of.begin[v]; i < surface.neighbours_of.begin[v + 1]; ++i) {
      const int w = surface.neighbours_of.items[i];
      const double most = part + steepest * norm(surface.x[w] - surface.x[v]) / plan.thickness[w];
      if (most >= plan.part[w]) continue;
      plan.part[w] = most;
      waiting.push({most, w});
    }
  }
}

[[noreturn]] void fail(const Plan& plan, int vertex, bool is_crossing) {
  throw Error("wall: no wall can grow at " + show(plan.surface.x[vertex]) + ", where " +
              show(plan.thickness[vertex]) + " mm are requested: " +
              (is_crossing ? "parts of it cross one another" : "elements are inverted") +
              " even with a twentieth of that. Smooth the lumen there, mesh it with smaller "
              "elements, or ask for less thickness.");
}

void take_back(Plan& plan, const std::vector<int>& vertices, bool is_crossing) {
  for (const int v : vertices) {
    plan.part[v] *= step_back;
    if (plan.part[v] < least_part) fail(plan, v, is_crossing);
  }
}

}  // namespace

double least_volume_part(const Plan& plan, int triangle) {
  const LumenSurface& surface = plan.surface;
  const auto& v = surface.triangles[triangle];
  const double height = (plan.left(v[0]) + plan.left(v[1]) + plan.left(v[2])) / 3.0;
  const double base = norm(surface.area_vector(triangle)) * height / 3.0;
  double least = 1.0;
  for (int level = 0; level < plan.steps(); ++level) {
    const double share = base * (plan.heights[level + 1] - plan.heights[level]);
    for (const auto& tet : prism(surface, triangle, level)) {
      std::array<Vec3, 4> c;
      for (int i = 0; i < 4; ++i)
        c[i] = plan.place(tet[i] % surface.vertices(), plan.heights[tet[i] / surface.vertices()]);
      least = std::min(least, signed_volume(c[0], c[1], c[2], c[3]) / share);
    }
  }
  return least;
}

void limit(Plan& plan, const std::vector<Corners>& obstacles) {
  spread_directions(plan);
  keep_clear_of_opposite(plan);
  for (int v = 0; v < plan.surface.vertices(); ++v)
    if (plan.part[v] < least_part) fail(plan, v, true);
  spread(plan);
  for (int round = 0; round < most_rounds; ++round) {
    const std::vector<int> folded = folded_triangles(plan);
    const std::vector<int> crossing =
        folded.empty() ? crossing_triangles(plan, obstacles) : std::vector<int>{};
    if (folded.empty() && crossing.empty()) return;
    const std::vector<int> vertices = vertices_of(plan, folded.empty() ? crossing : folded);
    if (!folded.empty()) turn(plan, vertices);
    for (const int v : crossing.empty() ? std::vector<int>{} : vertices) plan.is_dense[v] = true;
    if (folded.empty() || round >= turning_rounds) take_back(plan, vertices, folded.empty());
    spread(plan);
  }
  const std::vector<int> folded = folded_triangles(plan);
  if (!folded.empty()) fail(plan, plan.surface.triangles[folded[0]][0], false);
  const std::vector<int> crossing = crossing_triangles(plan, obstacles);
  if (!crossing.empty()) fail(plan, plan.surface.triangles[crossing[0]][0], true);
}

}  // namespace tunica::mesh::wall
