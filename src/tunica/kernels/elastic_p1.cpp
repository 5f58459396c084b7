#include "tunica/kernels/elastic_p1.hpp"

namespace tunica::kernels {

ElasticElement elastic_p1(const Tet4& T, double young, double poisson) {
  const double mu = T.volume * young / (2.0 * (1.0 + poisson));
  const double lambda = T.volume * young * poisson / ((1.0 + poisson) * (1.0 - 2.0 * poisson));
  ElasticElement K;
  for (int a = 0; a < 4; ++a)
    for (int b = 0; b < 4; ++b) {
      const auto &g = T.grad_N[a], &h = T.grad_N[b];
      for (int i = 0; i < 3; ++i)
        for (int j = 0; j < 3; ++j)
          K[3 * a + i][3 * b + j] =
              lambda * g[i] * h[j] + mu * g[j] * h[i] + (i == j ? mu * dot(g, h) : 0.0);
    }
  return K;
}

}  // namespace tunica::kernels
