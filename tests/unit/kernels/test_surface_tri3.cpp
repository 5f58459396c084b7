#include <Teuchos_UnitTestHarness.hpp>

#include "oracle/samples.hpp"
#include "oracle/surface_weak_form.hpp"
#include "tunica/kernels/surface_tri3.hpp"

namespace {

using namespace tunica;
using oracle::Deviation;
using oracle::Samples;
using Triangle = std::array<Vec3, 3>;
using Fad = oracle::First<9>;

Triangle random_triangle(Samples& samples, double size) {
  return {samples.vector(size), samples.vector(size), samples.vector(size)};
}

oracle::Triangle<Fad> seeded(const Triangle& x) {
  oracle::Triangle<Fad> y;
  for (int a = 0; a < 3; ++a)
    for (int i = 0; i < 3; ++i) oracle::seed(y[a][i], 3 * a + i, x[a][i]);
  return y;
}

/// Deviations of residual and Jacobian from a load that carries its derivatives.
std::array<double, 2> compare(const kernels::SurfaceResidual& R, const kernels::SurfaceJacobian& K,
                              const oracle::Triangle<Fad>& expected) {
  Deviation of_R, of_K;
  for (int a = 0; a < 3; ++a)
    for (int i = 0; i < 3; ++i) {
      of_R.add(R.u[a][i], expected[a][i].val());
      for (int b = 0; b < 3; ++b)
        for (int j = 0; j < 3; ++j) of_K.add(K.A[a][b][i][j], expected[a][i].dx(3 * b + j));
    }
  return {of_R.relative(), of_K.relative()};
}

TEUCHOS_UNIT_TEST(SurfaceTri3, area_normal_points_outward_with_the_size_of_the_area) {
  const Vec3 n = kernels::area_normal({{{0, 0, 1}, {2, 0, 1}, {0, 3, 1}}});
  TEST_ASSERT(n == (Vec3{0, 0, 3}));
}

TEUCHOS_UNIT_TEST(SurfaceTri3, dead_traction_loads_each_vertex_with_a_third) {
  const auto R = kernels::dead_traction({{{0, 0, 1}, {2, 0, 1}, {0, 3, 1}}}, {1, -2, 4});
  for (int a = 0; a < 3; ++a) TEST_ASSERT(R.u[a] == (Vec3{-1, 2, -4}));
}

TEUCHOS_UNIT_TEST(SurfaceTri3, follower_pressure_and_its_jacobian_are_those_of_the_weak_form) {
  Samples samples(31);
  for (int trial = 0; trial < 10; ++trial) {
    const Triangle x = random_triangle(samples, 0.3);
    kernels::SurfaceResidual R;
    kernels::SurfaceJacobian K;
    kernels::follower_pressure_jacobian(x, 1.332, R, K);
    const auto deviation = compare(R, K, oracle::pressure_load(seeded(x), 1.332));
    TEST_COMPARE(deviation[0], <, 1e-12);
    TEST_COMPARE(deviation[1], <, 1e-12);
    TEST_ASSERT(kernels::follower_pressure(x, 1.332).u == R.u);
  }
}

TEUCHOS_UNIT_TEST(SurfaceTri3, follower_pressure_on_a_closed_surface_has_no_resultant) {
  Samples samples(32);
  for (int trial = 0; trial < 10; ++trial) {
    const auto x = samples.tetrahedron();
    Vec3 force{0, 0, 0}, moment{0, 0, 0};
    for (const auto& face : {std::array<int, 3>{1, 2, 3}, {0, 3, 2}, {0, 1, 3}, {0, 2, 1}}) {
      const Triangle corners = {x[face[0]], x[face[1]], x[face[2]]};
      const auto R = kernels::follower_pressure(corners, 10.0);
      for (int a = 0; a < 3; ++a) {
        force += R.u[a];
        moment += cross(corners[a], R.u[a]);
      }
    }
    TEST_COMPARE(norm(force), <, 1e-15);
    TEST_COMPARE(norm(moment), <, 1e-15);
  }
}

TEUCHOS_UNIT_TEST(SurfaceTri3, backflow_and_its_jacobian_are_those_of_the_quadrature_sum) {
  Samples samples(33);
  int partial = 0;
  for (int trial = 0; trial < 40; ++trial) {
    const Triangle x = random_triangle(samples, 0.3);
    const Triangle u = random_triangle(samples, 2.0);
    const Triangle w = random_triangle(samples, 1.0);
    kernels::SurfaceResidual R;
    kernels::SurfaceJacobian K;
    kernels::backflow_jacobian(x, u, w, 0.2, R, K);
    const auto expected = oracle::backflow_load<Fad>(x, seeded(u), w, 0.2, oracle::radon_rule());
    const auto deviation = compare(R, K, expected);
    TEST_COMPARE(deviation[0], <, 1e-12);
    TEST_COMPARE(deviation[1], <, 1e-12);
    TEST_ASSERT(kernels::backflow(x, u, w, 0.2).u == R.u);
    const Vec3 n = kernels::area_normal(x);
    int entering = 0;
    for (int a = 0; a < 3; ++a) entering += dot(u[a] - w[a], n) < 0.0;
    partial += entering == 1 || entering == 2;
  }
  TEST_COMPARE(partial, >, 5);
}

TEUCHOS_UNIT_TEST(SurfaceTri3, loads_know_how_they_change_where_the_triangle_moves) {
  Samples samples(36);
  const double rate = 8.0;
  for (int trial = 0; trial < 20; ++trial) {
    const Triangle x = random_triangle(samples, 0.3);
    const Triangle u = random_triangle(samples, 2.0);
    const Triangle w = random_triangle(samples, 1.0);
    const Vec3 t = samples.vector(2.0);
    kernels::SurfaceJacobian K;
    kernels::dead_traction_shape(x, t, K);
    TEST_COMPARE(compare(kernels::dead_traction(x, t), K, oracle::traction_load(seeded(x), t))[1],
                 <, 1e-12);
    oracle::Triangle<Fad> moving = seeded(x), velocity;
    for (int a = 0; a < 3; ++a)
      for (int i = 0; i < 3; ++i) velocity[a][i] = w[a][i] + rate * (moving[a][i] - x[a][i]);
    kernels::backflow_shape(x, u, w, 0.2, rate, K);
    const auto expected =
        oracle::backflow_load<Fad>(moving, u, velocity, 0.2, oracle::radon_rule());
    TEST_COMPARE(compare(kernels::backflow(x, u, w, 0.2), K, expected)[1], <, 1e-12);
  }
}

TEUCHOS_UNIT_TEST(SurfaceTri3, backflow_is_exact_where_all_fluid_enters) {
  Samples samples(34);
  const Triangle x = {{{0, 0, 0}, {0.3, 0, 0}, {0.1, 0.4, 0}}};
  Triangle u = random_triangle(samples, 1.0);
  Triangle w = random_triangle(samples, 1.0);
  for (int a = 0; a < 3; ++a) u[a][2] -= 3.0;
  const auto R = kernels::backflow(x, u, w, 0.2);
  const auto exact = oracle::backflow_load<double>(x, u, w, 0.2, oracle::tri_rule());
  Deviation of_R;
  for (int a = 0; a < 3; ++a)
    for (int i = 0; i < 3; ++i) of_R.add(R.u[a][i], exact[a][i]);
  TEST_COMPARE(of_R.relative(), <, 1e-13);
}

TEUCHOS_UNIT_TEST(SurfaceTri3, backflow_never_adds_power_and_ignores_outflow) {
  Samples samples(35);
  for (int trial = 0; trial < 40; ++trial) {
    const Triangle x = random_triangle(samples, 0.3);
    const Triangle u = random_triangle(samples, 2.0);
    const auto R = kernels::backflow(x, u, random_triangle(samples, 1.0), 0.2);
    TEST_COMPARE(dot(R.u[0], u[0]) + dot(R.u[1], u[1]) + dot(R.u[2], u[2]), >=, 0.0);
    const Vec3 outflow = (10.0 / norm(kernels::area_normal(x))) * kernels::area_normal(x);
    const auto none =
        kernels::backflow(x, {outflow, outflow, outflow}, random_triangle(samples, 1.0), 0.2);
    for (int a = 0; a < 3; ++a) TEST_ASSERT(none.u[a] == (Vec3{0, 0, 0}));
  }
}

}  // namespace
