#include <Teuchos_UnitTestHarness.hpp>

#include "tunica/stepping/newmark.hpp"

namespace {

using namespace tunica;
using stepping::Newmark;

const Vec3 d_old{0.1, -0.2, 0.3}, v_old{1.0, 2.0, -1.0}, a_old{0.5, -3.0, 4.0};

TEUCHOS_UNIT_TEST(newmark, average_acceleration_integrates_constant_acceleration_exactly) {
  const Newmark scheme{0.25, 0.5, 0.3};
  const double dt = scheme.dt;
  const Vec3 d = d_old + dt * v_old + (0.5 * dt * dt) * a_old;
  const Vec3 a = scheme.acceleration(d, d_old, v_old, a_old);
  const Vec3 v = scheme.velocity(a, v_old, a_old);
  for (int i = 0; i < 3; ++i) {
    TEST_FLOATING_EQUALITY(a[i], a_old[i], 1e-13);
    TEST_FLOATING_EQUALITY(v[i], v_old[i] + dt * a_old[i], 1e-13);
  }
}

TEUCHOS_UNIT_TEST(newmark, constant_acceleration_is_exact_for_the_papers_parameters_too) {
  const Newmark scheme{0.625, 1.0, 0.125};
  const double dt = scheme.dt;
  Vec3 d = d_old, v = v_old;
  for (int n = 1; n <= 4; ++n) {
    const double t = n * dt;
    const Vec3 d_new = d_old + t * v_old + (0.5 * t * t) * a_old;
    const Vec3 a = scheme.acceleration(d_new, d, v, a_old);
    v = scheme.velocity(a, v, a_old);
    d = d_new;
    for (int i = 0; i < 3; ++i) {
      TEST_FLOATING_EQUALITY(a[i], a_old[i], 1e-11);
      TEST_FLOATING_EQUALITY(v[i], v_old[i] + t * a_old[i], 1e-12);
    }
  }
}

TEUCHOS_UNIT_TEST(newmark, inertia_is_alpha_d_minus_load) {
  const Newmark scheme{0.625, 1.0, 0.125};
  const double density = 1.2;
  const Vec3 d{0.4, 0.1, -0.7};
  const Vec3 a = scheme.acceleration(d, d_old, v_old, a_old);
  const Vec3 r = scheme.load(density, d_old, v_old, a_old);
  for (int i = 0; i < 3; ++i)
    TEST_FLOATING_EQUALITY(scheme.alpha(density) * d[i] - r[i], density * a[i], 1e-12);
}

TEUCHOS_UNIT_TEST(newmark, numbers_by_hand) {
  // β Δt² = 0.625 / 4 = 0.15625: 1/0.15625 = 6.4; 1/(β Δt) = 3.2; (1 − 2β)/(2β) = −0.2
  const Newmark scheme{0.625, 1.0, 0.5};
  const Vec3 a = scheme.acceleration({1, 0, 0}, {0, 0, 0}, {1, 0, 0}, {1, 0, 0});
  TEST_FLOATING_EQUALITY(a[0], 6.4 - 3.2 + 0.2, 1e-14);
  TEST_FLOATING_EQUALITY(scheme.velocity(a, {1, 0, 0}, {1, 0, 0})[0], 1.0 + 0.5 * 3.4, 1e-14);
}

}  // namespace
