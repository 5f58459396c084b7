#include "tunica/kernels/elastic_p1.hpp"

#include "tunica/kernels/surface_tri3.hpp"

namespace tunica::kernels {

namespace {

/// Of any simplex: stiffness is Young's modulus times its volume or area.
template <std::size_t n>
std::array<std::array<double, 3 * n>, 3 * n> elastic_simplex(const std::array<Vec3, n>& grad_N,
                                                             double stiffness, double poisson) {
  const double mu = stiffness / (2.0 * (1.0 + poisson));
  const double lambda = stiffness * poisson / ((1.0 + poisson) * (1.0 - 2.0 * poisson));
  std::array<std::array<double, 3 * n>, 3 * n> K;
  for (std::size_t a = 0; a < n; ++a)
    for (std::size_t b = 0; b < n; ++b) {
      const auto &g = grad_N[a], &h = grad_N[b];
      for (int i = 0; i < 3; ++i)
        for (int j = 0; j < 3; ++j)
          K[3 * a + i][3 * b + j] =
              lambda * g[i] * h[j] + mu * g[j] * h[i] + (i == j ? mu * dot(g, h) : 0.0);
    }
  return K;
}

}  // namespace

ElasticElement elastic_p1(const Tet4& T, double young, double poisson) {
  return elastic_simplex<4>(T.grad_N, T.volume * young, poisson);
}

ElasticTriangle elastic_p1(const std::array<Vec3, 3>& x, double young, double poisson) {
  const Vec3 An = area_normal(x);
  const double A = norm(An);
  // g_a = n × e_a/(2 A), e_a the edge that faces corner a
  std::array<Vec3, 3> grad_N;
  for (int a = 0; a < 3; ++a)
    grad_N[a] = 0.5 / (A * A) * cross(An, x[(a + 2) % 3] - x[(a + 1) % 3]);
  return elastic_simplex<3>(grad_N, A * young, poisson);
}

}  // namespace tunica::kernels
