#include "tunica/kernels/wall_stress.hpp"

#include <algorithm>
#include <functional>

#include "tunica/kernels/deformation.hpp"

namespace tunica::kernels {

Sym3 cauchy_stress(const Tet4& T, const std::array<Vec3, 4>& d, const std::array<double, 4>& p,
                   const materials::HyperelasticLaw& law, const materials::Frame& frame) {
  const Mat3 F = deformation_gradient(T, d);
  const Sym3 S = law.stress(right_cauchy_green(F), frame);
  const double inv_J = 1.0 / det(F);
  const double p_mean = 0.25 * (p[0] + p[1] + p[2] + p[3]);
  // (F S Fᵀ)_ij = F_i · S F_j with the rows of F
  const Vec3 SF[3] = {apply(S, F[0]), apply(S, F[1]), apply(S, F[2])};
  return {inv_J * dot(F[0], SF[0]) - p_mean, inv_J * dot(F[1], SF[1]) - p_mean,
          inv_J * dot(F[2], SF[2]) - p_mean, inv_J * dot(F[0], SF[1]),
          inv_J * dot(F[1], SF[2]),          inv_J * dot(F[2], SF[0])};
}

Vec3 principal_values(const Sym3& s) {
  Mat3 A{{{s[0], s[3], s[5]}, {s[3], s[1], s[4]}, {s[5], s[4], s[2]}}};
  const auto rotate = [&A](int p, int q) {  // A ← Gᵀ A G, such that A_pq = 0
    if (A[p][q] == 0.0) return;
    const double theta = 0.5 * (A[q][q] - A[p][p]) / A[p][q];
    const double t =
        (theta >= 0.0 ? 1.0 : -1.0) / (std::abs(theta) + std::sqrt(theta * theta + 1.0));
    const double c = 1.0 / std::sqrt(t * t + 1.0), sine = t * c;
    for (int k = 0; k < 3; ++k) {
      const double at_p = A[k][p], at_q = A[k][q];
      A[k][p] = c * at_p - sine * at_q;
      A[k][q] = sine * at_p + c * at_q;
    }
    for (int k = 0; k < 3; ++k) {
      const double at_p = A[p][k], at_q = A[q][k];
      A[p][k] = c * at_p - sine * at_q;
      A[q][k] = sine * at_p + c * at_q;
    }
  };
  const double size = std::abs(s[0]) + std::abs(s[1]) + std::abs(s[2]);
  // Each sweep squares what is left beside the diagonal, which is seen at the squares of values.
  for (int sweep = 0; sweep < 8; ++sweep) {
    const double rest = std::abs(A[0][1]) + std::abs(A[0][2]) + std::abs(A[1][2]);
    if (rest <= 1e-12 * size) break;
    rotate(0, 1);
    rotate(0, 2);
    rotate(1, 2);
  }
  Vec3 values{A[0][0], A[1][1], A[2][2]};
  std::sort(values.begin(), values.end(), std::greater<>());
  return values;
}

double von_mises(const Sym3& s) {
  const double xy = s[0] - s[1];
  const double yz = s[1] - s[2];
  const double zx = s[2] - s[0];
  return std::sqrt(0.5 * (xy * xy + yz * yz + zx * zx) +
                   3.0 * (s[3] * s[3] + s[4] * s[4] + s[5] * s[5]));
}

}  // namespace tunica::kernels
