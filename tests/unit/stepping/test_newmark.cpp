#include <Teuchos_UnitTestHarness.hpp>

#include "tunica/stepping/newmark.hpp"

namespace {

using namespace tunica;
using stepping::Newmark;
using stepping::Timeline;

const Vec3 d_old{0.1, -0.2, 0.3}, v_old{1.0, 2.0, -1.0}, a_old{0.5, -3.0, 4.0};

Newmark scheme(double beta, double gamma, double dt) {
  Newmark newmark(beta, gamma);
  newmark.set_step_size(dt);
  return newmark;
}

/// Of three numbers.
Timeline history_of(const Newmark& newmark, const Vec3& d, const Vec3& v, const Vec3& a) {
  Timeline history(fields::Places::everywhere(), 3, newmark.remembers());
  history.value() = fields::as_rows({d});
  history[0] = fields::as_rows({v});
  history[1] = fields::as_rows({a});
  return history;
}

TEUCHOS_UNIT_TEST(newmark, average_acceleration_integrates_constant_acceleration_exactly) {
  const double dt = 0.3;
  const Newmark newmark = scheme(0.25, 0.5, dt);
  Timeline history = history_of(newmark, d_old, v_old, a_old);
  newmark.accept(fields::as_rows({d_old + dt * v_old + (0.5 * dt * dt) * a_old}), history);
  for (int i = 0; i < 3; ++i) {
    TEST_FLOATING_EQUALITY(history[1][i], a_old[i], 1e-13);
    TEST_FLOATING_EQUALITY(history[0][i], v_old[i] + dt * a_old[i], 1e-13);
  }
}

TEUCHOS_UNIT_TEST(newmark, constant_acceleration_is_exact_for_the_papers_parameters_too) {
  const double dt = 0.125;
  const Newmark newmark = scheme(0.625, 1.0, dt);
  Timeline history = history_of(newmark, d_old, v_old, a_old);
  for (int n = 1; n <= 4; ++n) {
    const double t = n * dt;
    newmark.accept(fields::as_rows({d_old + t * v_old + (0.5 * t * t) * a_old}), history);
    for (int i = 0; i < 3; ++i) {
      TEST_FLOATING_EQUALITY(history[1][i], a_old[i], 1e-11);
      TEST_FLOATING_EQUALITY(history[0][i], v_old[i] + t * a_old[i], 1e-12);
    }
  }
}

TEUCHOS_UNIT_TEST(newmark, rates_are_affine_in_the_new_value) {
  const Newmark newmark = scheme(0.625, 0.8, 0.125);
  const Timeline before = history_of(newmark, d_old, v_old, a_old);
  const double density = 1.2;
  const Vec3 d{0.4, 0.1, -0.7};
  const stepping::Rows r = newmark.inertia_loads(before), past = newmark.pasts(before);
  Timeline after = before;
  newmark.accept(fields::as_rows({d}), after);
  for (int i = 0; i < 3; ++i) {  // ρ a = α d − ρ r,  v = c (d − d̃)
    TEST_FLOATING_EQUALITY(newmark.inertia(density) * d[i] - density * r[i], density * after[1][i],
                           1e-12);
    TEST_FLOATING_EQUALITY(newmark.rate() * (d[i] - past[i]), after[0][i], 1e-12);
  }
}

TEUCHOS_UNIT_TEST(newmark, numbers_by_hand) {
  // β Δt² = 0.625 / 4 = 0.15625: 1/0.15625 = 6.4; 1/(β Δt) = 3.2; (1 − 2β)/(2β) = −0.2
  const Newmark newmark = scheme(0.625, 1.0, 0.5);
  Timeline history = history_of(newmark, {0, 0, 0}, {1, 0, 0}, {1, 0, 0});
  newmark.accept({1, 0, 0}, history);
  TEST_FLOATING_EQUALITY(history[1][0], 6.4 - 3.2 + 0.2, 1e-14);
  TEST_FLOATING_EQUALITY(history[0][0], 1.0 + 0.5 * 3.4, 1e-14);
}

}  // namespace
