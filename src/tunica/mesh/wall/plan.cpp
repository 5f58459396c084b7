#include "tunica/mesh/wall/plan.hpp"

#include <algorithm>

namespace tunica::mesh::wall {

Plan::Plan(const LumenSurface& of, const std::vector<Layer>& layers, std::vector<double> wanted)
    : surface(of), heights{0.0}, thickness(std::move(wanted)),
      growth(growth_directions(of, thickness)), part(thickness.size(), 1.0),
      is_dense(thickness.size(), false) {
  double total = 0.0, below = 0.0;
  for (const Layer& each : layers) total += each.thickness;
  for (std::size_t l = 0; l < layers.size(); ++l) {
    for (int i = 1; i <= layers[l].elements; ++i) {
      heights.push_back((below + layers[l].thickness * i / layers[l].elements) / total);
      layer.push_back(static_cast<int>(l));
    }
    below += layers[l].thickness;
  }
  heights.back() = 1.0;
}

std::array<std::array<int, 4>, 3> prism(const LumenSurface& surface, int triangle, int level) {
  std::array<int, 3> v = surface.triangles[triangle];
  bool is_even = true;
  const auto order = [&](int i, int j) {
    if ((v[i] < v[j]) == (level % 2 == 0)) return;
    std::swap(v[i], v[j]);
    is_even = !is_even;
  };
  order(0, 1);
  order(1, 2);
  order(0, 1);
  const int low = level * surface.vertices(), high = low + surface.vertices();
  const int p = low + v[0], q = low + v[1], r = low + v[2];
  const int P = high + v[0], Q = high + v[1], R = high + v[2];
  if (is_even) return {{{p, q, r, R}, {p, q, R, Q}, {p, P, Q, R}}};
  return {{{p, q, R, r}, {p, q, Q, R}, {p, P, R, Q}}};
}

std::array<std::array<int, 3>, 2> side(const LumenSurface& surface, const std::array<int, 2>& edge,
                                       int level) {
  const int low = level * surface.vertices(), high = low + surface.vertices();
  const int a = low + edge[0], b = low + edge[1], A = high + edge[0], B = high + edge[1];
  if ((edge[0] < edge[1]) == (level % 2 == 0)) return {{{a, b, B}, {a, B, A}}};
  return {{{a, b, A}, {b, B, A}}};
}

}  // namespace tunica::mesh::wall
