#pragma once
#include <array>
#include <vector>

namespace tunica::oracle {

/// Barycentric coordinates and a weight; the weights of a rule add up to 1.
struct TetPoint {
  double weight;
  std::array<double, 4> N;
};
struct TriPoint {
  double weight;
  std::array<double, 3> N;
};

/// Four Gauss–Legendre points on (0, 1), exact to degree 7.
struct Gauss4 {
  double x[4] = {0.0694318442029737124, 0.330009478207571868, 0.669990521792428132,
                 0.930568155797026288};
  double w[4] = {0.173927422568726929, 0.326072577431273071, 0.326072577431273071,
                 0.173927422568726929};
};

/// Collapsed cube, 64 points, exact to degree 5 on the tetrahedron.
inline std::vector<TetPoint> tet_rule() {
  const Gauss4 g;
  std::vector<TetPoint> rule;
  for (int i = 0; i < 4; ++i)
    for (int j = 0; j < 4; ++j)
      for (int k = 0; k < 4; ++k) {
        const double x = g.x[i];
        const double y = g.x[j] * (1 - x);
        const double z = g.x[k] * (1 - x - y);
        const double jacobian = (1 - x) * (1 - x - y);
        rule.push_back({6 * g.w[i] * g.w[j] * g.w[k] * jacobian, {1 - x - y - z, x, y, z}});
      }
  return rule;
}

/// Collapsed square, 16 points, exact to degree 6 on the triangle.
inline std::vector<TriPoint> tri_rule() {
  const Gauss4 g;
  std::vector<TriPoint> rule;
  for (int i = 0; i < 4; ++i)
    for (int j = 0; j < 4; ++j) {
      const double x = g.x[i];
      const double y = g.x[j] * (1 - x);
      rule.push_back({2 * g.w[i] * g.w[j] * (1 - x), {1 - x - y, x, y}});
    }
  return rule;
}

/// Radon's rule of degree 5 as printed in tables.
inline std::vector<TriPoint> radon_rule() {
  const double a = 0.059715871789770, b = 0.470142064105115, v = 0.132394152788506;
  const double c = 0.797426985353087, d = 0.101286507323456, w = 0.125939180544827;
  return {{0.225, {1 / 3., 1 / 3., 1 / 3.}},
          {v, {a, b, b}},
          {v, {b, a, b}},
          {v, {b, b, a}},
          {w, {c, d, d}},
          {w, {d, c, d}},
          {w, {d, d, c}}};
}

}  // namespace tunica::oracle
