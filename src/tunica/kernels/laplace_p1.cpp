#include "tunica/kernels/laplace_p1.hpp"

namespace tunica::kernels {

std::array<std::array<double, 4>, 4> laplace_p1(const Tet4& T) {
  std::array<std::array<double, 4>, 4> K;
  for (int a = 0; a < 4; ++a)
    for (int b = 0; b <= a; ++b) K[a][b] = K[b][a] = T.volume * dot(T.grad_N[a], T.grad_N[b]);
  return K;
}

}  // namespace tunica::kernels
