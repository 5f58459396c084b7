#include "tunica/kernels/tet4.hpp"

namespace tunica::kernels {

// ∇N_a = n_a / (−3 V), n_a the outward area normal of the face opposite to a. The first is minus
// the sum of the others, so that constants have no gradient.
Tet4 make_tet4(const std::array<Vec3, 4>& x) {
  const Vec3 e1 = x[1] - x[0];
  const Vec3 e2 = x[2] - x[0];
  const Vec3 e3 = x[3] - x[0];
  const Vec3 n1 = cross(e2, e3);
  const double six_V = dot(e1, n1);
  const double scale = 1.0 / six_V;
  Tet4 T;
  T.volume = six_V / 6.0;
  T.grad_N[1] = scale * n1;
  T.grad_N[2] = scale * cross(e3, e1);
  T.grad_N[3] = scale * cross(e1, e2);
  T.grad_N[0] = -1.0 * (T.grad_N[1] + T.grad_N[2] + T.grad_N[3]);
  return T;
}

double element_length(double volume) {
  constexpr double six_sqrt2 = 8.48528137423857;
  return std::cbrt(six_sqrt2 * volume);
}

}  // namespace tunica::kernels
