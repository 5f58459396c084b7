#include "tunica/kernels/wall_stress.hpp"

#include <cmath>

#include "tunica/kernels/deformation.hpp"

namespace tunica::kernels {

Sym3 cauchy_stress(const Tet4& T, const std::array<Vec3, 4>& d, const std::array<double, 4>& p,
                   const materials::WallLaw& law, const materials::Frame& frame,
                   const materials::Past& past) {
  const Mat3 F = deformation_gradient(T, d);
  const Sym3 S = law.stress(right_cauchy_green(F), frame, past);
  const double inv_J = 1.0 / det(F);
  const double p_mean = 0.25 * (p[0] + p[1] + p[2] + p[3]);
  // (F S Fᵀ)_ij = F_i · S F_j with the rows of F
  const Vec3 SF[3] = {apply(S, F[0]), apply(S, F[1]), apply(S, F[2])};
  return {inv_J * dot(F[0], SF[0]) - p_mean, inv_J * dot(F[1], SF[1]) - p_mean,
          inv_J * dot(F[2], SF[2]) - p_mean, inv_J * dot(F[0], SF[1]),
          inv_J * dot(F[1], SF[2]),          inv_J * dot(F[2], SF[0])};
}

double von_mises(const Sym3& s) {
  const double xy = s[0] - s[1];
  const double yz = s[1] - s[2];
  const double zx = s[2] - s[0];
  return std::sqrt(0.5 * (xy * xy + yz * yz + zx * zx) +
                   3.0 * (s[3] * s[3] + s[4] * s[4] + s[5] * s[5]));
}

}  // namespace tunica::kernels
