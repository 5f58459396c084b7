#include <Teuchos_UnitTestHarness.hpp>

#include "oracle/algebra.hpp"
#include "oracle/quadrature.hpp"
#include "oracle/samples.hpp"
#include "tunica/kernels/energy.hpp"
#include "tunica/kernels/fluid_tau.hpp"
#include "tunica/kernels/fluid_up.hpp"
#include "tunica/kernels/surface_tri3.hpp"
#include "tunica/materials/newtonian.hpp"

namespace {

using namespace tunica;

const materials::Newtonian viscous_fluid(0.5), ideal_fluid(0.0), blood_law(3.5e-3);
using oracle::Samples;

kernels::FluidState random_state(Samples& samples) {
  return {samples.vectors(2.0), samples.numbers(2.0), samples.vectors(2.0), samples.vectors(0.5),
          samples.vectors(3.0)};
}

TEUCHOS_UNIT_TEST(Energy, squared_norm_is_that_of_quadrature) {
  Samples samples(41);
  const double V = kernels::make_tet4(samples.tetrahedron()).volume;
  const auto v = samples.vectors(2.0);
  double expected = 0.0;
  for (const oracle::TetPoint& q : oracle::tet_rule()) {
    const Vec3 at = oracle::at(q.N, v);
    expected += q.weight * V * dot(at, at);
  }
  TEST_FLOATING_EQUALITY(kernels::squared_norm(V, v), expected, 1e-12);
}

TEUCHOS_UNIT_TEST(Energy, viscous_dissipation_is_the_power_of_the_viscous_residual) {
  Samples samples(42);
  for (int trial = 0; trial < 5; ++trial) {
    const kernels::Tet4 T = kernels::make_tet4(samples.tetrahedron());
    const kernels::FluidState s = random_state(samples);
    const auto with = fluid_up_residual(T, s, {1.0, &viscous_fluid, 8.0}, 0.0),
               without = fluid_up_residual(T, s, {1.0, &ideal_fluid, 8.0}, 0.0);
    double power = 0.0;
    for (int a = 0; a < 4; ++a) power += dot(s.u[a], with.u[a] - without.u[a]);
    TEST_FLOATING_EQUALITY(kernels::viscous_dissipation(T, s.u, viscous_fluid), power, 1e-11);
  }
}

TEUCHOS_UNIT_TEST(Energy, rigid_rotation_dissipates_nothing) {
  Samples samples(43);
  const auto x = samples.tetrahedron();
  const Vec3 spin{0.3, -2.0, 1.1};
  const double power = kernels::viscous_dissipation(
      kernels::make_tet4(x),
      {cross(spin, x[0]), cross(spin, x[1]), cross(spin, x[2]), cross(spin, x[3])}, viscous_fluid);
  TEST_COMPARE(power, <, 1e-28);
}

TEUCHOS_UNIT_TEST(Energy, stabilisation_power_is_that_of_the_residual) {
  Samples samples(44);
  const kernels::FluidCoefficients c{1.06, &blood_law, 8.0};
  for (int trial = 0; trial < 5; ++trial) {
    const kernels::Tet4 T = kernels::make_tet4(samples.tetrahedron());
    kernels::FluidState s = random_state(samples);
    s.on_wall = {0.0, 1.0, 1.0, 0.0};
    s.subscale = samples.vector(0.7);
    const double tau = fluid_tau(T, samples.vector(2.0), blood_law.reference(), c);
    const auto with = fluid_up_residual(T, s, c, tau), without = fluid_up_residual(T, s, c, 0.0);
    double power = 0.0;
    for (int a = 0; a < 4; ++a)
      power += dot(s.u[a], with.u[a] - without.u[a]) - s.p[a] * (with.p[a] - without.p[a]) -
               0.25 * T.volume * c.density * c.inv_dt * s.on_wall[a] * dot(s.u[a], s.subscale);
    TEST_FLOATING_EQUALITY(kernels::fluid_stabilisation_power(T, s, c, tau), power, 1e-11);
  }
}

TEUCHOS_UNIT_TEST(Energy, kinetic_outflow_is_that_of_quadrature) {
  Samples samples(45);
  const auto triangle = [&samples](double size) {
    return std::array<Vec3, 3>{samples.vector(size), samples.vector(size), samples.vector(size)};
  };
  const auto x = triangle(0.3), u = triangle(2.0), w = triangle(1.0);
  double expected = 0.0;
  for (const oracle::TriPoint& q : oracle::tri_rule()) {
    const Vec3 v = oracle::at(q.N, u);
    expected += q.weight * 0.5 * dot(v, v) * dot(v - oracle::at(q.N, w), kernels::area_normal(x));
  }
  TEST_FLOATING_EQUALITY(kernels::kinetic_outflow(x, u, w), expected, 1e-12);
}

}  // namespace
