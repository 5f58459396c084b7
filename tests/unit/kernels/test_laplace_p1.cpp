#include <Teuchos_UnitTestHarness.hpp>

#include "oracle/algebra.hpp"
#include "oracle/samples.hpp"
#include "tunica/kernels/laplace_p1.hpp"
#include "tunica/kernels/surface_tri3.hpp"

namespace {

using namespace tunica;
using oracle::Deviation;
using oracle::Samples;

TEUCHOS_UNIT_TEST(Tet4, gradients_are_those_of_the_affine_map) {
  Samples samples(41);
  for (int trial = 0; trial < 20; ++trial) {
    const auto x = samples.tetrahedron();
    const kernels::Tet4 T = kernels::make_tet4(x);
    const oracle::Element expected(x);
    Deviation of_gradient;
    for (int a = 0; a < 4; ++a)
      for (int i = 0; i < 3; ++i) of_gradient.add(T.grad_N[a][i], expected.grad_N[a][i]);
    TEST_COMPARE(of_gradient.relative(), <, 1e-12);
    TEST_FLOATING_EQUALITY(T.volume, expected.volume, 1e-12);
  }
}

TEUCHOS_UNIT_TEST(Tet4, element_length_is_the_edge_of_a_regular_tetrahedron) {
  const kernels::Tet4 T =
      kernels::make_tet4<double>({{{1, 1, 1}, {-1, 1, -1}, {1, -1, -1}, {-1, -1, 1}}});
  TEST_FLOATING_EQUALITY(kernels::element_length(T.volume), std::sqrt(8.0), 1e-14);
}

TEUCHOS_UNIT_TEST(LaplaceP1, energy_of_a_linear_field_is_volume_times_squared_gradient) {
  Samples samples(42);
  const auto x = samples.tetrahedron();
  const kernels::Tet4 T = kernels::make_tet4(x);
  const auto K = kernels::laplace_p1(T);
  const Vec3 slope = samples.vector(1.0);
  double energy = 0.0;
  for (int a = 0; a < 4; ++a) {
    double row = 0.0;
    for (int b = 0; b < 4; ++b) {
      energy += dot(slope, x[a]) * K[a][b] * dot(slope, x[b]);
      row += K[a][b];
    }
    TEST_COMPARE(std::abs(row), <, 1e-14);
  }
  TEST_FLOATING_EQUALITY(energy, T.volume * dot(slope, slope), 1e-12);
}

TEUCHOS_UNIT_TEST(LaplaceP1, energy_in_a_triangle_is_area_times_the_squared_slope_within_it) {
  Samples samples(43);
  const auto tet = samples.tetrahedron();
  const std::array<Vec3, 3> x{tet[0], tet[1], tet[2]};
  const Vec3 n = kernels::area_normal(x);
  const auto K = kernels::laplace_p1(x);
  const Vec3 slope = samples.vector(1.0);
  const Vec3 within = slope - dot(slope, n) / dot(n, n) * n;
  double energy = 0.0;
  for (int a = 0; a < 3; ++a)
    for (int b = 0; b < 3; ++b) energy += dot(slope, x[a]) * K[a][b] * dot(slope, x[b]);
  TEST_FLOATING_EQUALITY(energy, norm(n) * dot(within, within), 1e-12);
}

}  // namespace
