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

}  // namespace
