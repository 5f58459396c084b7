#include <Teuchos_UnitTestHarness.hpp>

#include "oracle/samples.hpp"
#include "tunica/kernels/elastic_p1.hpp"

namespace {

using namespace tunica;
using oracle::Samples;

TEUCHOS_UNIT_TEST(ElasticP1, energy_of_a_linear_displacement_is_that_of_its_strain) {
  Samples samples(44);
  const auto x = samples.tetrahedron();
  const kernels::Tet4 T = kernels::make_tet4(x);
  const double E = 2.5, nu = 0.3;
  const auto K = kernels::elastic_p1(T, E, nu);
  const std::array<Vec3, 3> H{samples.vector(1.0), samples.vector(1.0), samples.vector(1.0)};
  double energy = 0.0, antisymmetry = 0.0;
  for (int a = 0; a < 4; ++a)
    for (int b = 0; b < 4; ++b)
      for (int i = 0; i < 3; ++i)
        for (int j = 0; j < 3; ++j) {
          energy += dot(H[i], x[a]) * K[3 * a + i][3 * b + j] * dot(H[j], x[b]);
          antisymmetry =
              std::max(antisymmetry, std::abs(K[3 * a + i][3 * b + j] - K[3 * b + j][3 * a + i]));
        }
  // W = E/(2(1 + ν)) (2 ε:ε + 2ν/(1 − 2ν) tr²ε) V, twice the energy of Hooke's law
  double squares = 0.0, trace = 0.0;
  for (int i = 0; i < 3; ++i) {
    trace += H[i][i];
    for (int j = 0; j < 3; ++j) squares += std::pow(0.5 * (H[i][j] + H[j][i]), 2);
  }
  const double expected =
      E / (2.0 * (1.0 + nu)) * (2.0 * squares + 2.0 * nu / (1.0 - 2.0 * nu) * trace * trace);
  TEST_FLOATING_EQUALITY(energy, T.volume * expected, 1e-12);
  TEST_COMPARE(antisymmetry, <, 1e-14 * E);
}

TEUCHOS_UNIT_TEST(ElasticP1, a_triangle_has_the_energy_of_plane_strain_and_of_a_membrane_across) {
  Samples samples(45);
  const std::array<Vec3, 3> x{samples.vector(1.0), samples.vector(1.0), samples.vector(1.0)};
  const double E = 2.5, nu = 0.3;
  const kernels::ElasticTriangle K = kernels::elastic_p1(x, E, nu);
  // Axes with the first two in the plane
  const Vec3 normal = cross(x[1] - x[0], x[2] - x[0]);
  const double area = 0.5 * norm(normal);
  std::array<Vec3, 3> axes;
  axes[0] = 1.0 / norm(x[1] - x[0]) * (x[1] - x[0]);
  axes[2] = 1.0 / norm(normal) * normal;
  axes[1] = cross(axes[2], axes[0]);
  double H[3][2];  // H[i][j] = ∂d_i/∂x_j in these axes
  for (auto& row : H)
    for (double& entry : row) entry = samples.vector(1.0)[0];
  std::array<Vec3, 3> d{};
  for (int a = 0; a < 3; ++a)
    for (int i = 0; i < 3; ++i)
      d[a] += (H[i][0] * dot(axes[0], x[a]) + H[i][1] * dot(axes[1], x[a])) * axes[i];
  double energy = 0.0;
  for (int a = 0; a < 3; ++a)
    for (int b = 0; b < 3; ++b)
      for (int i = 0; i < 3; ++i)
        for (int j = 0; j < 3; ++j) energy += d[a][i] * K[3 * a + i][3 * b + j] * d[b][j];
  const double mu = E / (2.0 * (1.0 + nu)), lambda = 2.0 * mu * nu / (1.0 - 2.0 * nu);
  const double shear = 0.5 * (H[0][1] + H[1][0]), trace = H[0][0] + H[1][1];
  const double expected = 2.0 * mu * (H[0][0] * H[0][0] + H[1][1] * H[1][1] + 2.0 * shear * shear) +
                          lambda * trace * trace + mu * (H[2][0] * H[2][0] + H[2][1] * H[2][1]);
  TEST_FLOATING_EQUALITY(energy, area * expected, 1e-12);
}

}  // namespace
