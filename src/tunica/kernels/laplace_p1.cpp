#include "tunica/kernels/laplace_p1.hpp"

#include "tunica/kernels/surface_tri3.hpp"

namespace tunica::kernels {

std::array<std::array<double, 4>, 4> laplace_p1(const Tet4& T) {
  std::array<std::array<double, 4>, 4> K;
  for (int a = 0; a < 4; ++a)
    for (int b = 0; b <= a; ++b) K[a][b] = K[b][a] = T.volume * dot(T.grad_N[a], T.grad_N[b]);
  return K;
}

std::array<std::array<double, 3>, 3> laplace_p1(const std::array<Vec3, 3>& x) {
  const double A = norm(area_normal(x));
  std::array<Vec3, 3> edge;
  for (int a = 0; a < 3; ++a) edge[a] = x[(a + 2) % 3] - x[(a + 1) % 3];
  std::array<std::array<double, 3>, 3> K;
  for (int a = 0; a < 3; ++a)
    for (int b = 0; b < 3; ++b) K[a][b] = dot(edge[a], edge[b]) / (4.0 * A);
  return K;
}

}  // namespace tunica::kernels
