#include <Teuchos_UnitTestHarness.hpp>
#include <cmath>

#include "oracle/samples.hpp"
#include "tunica/materials/mooney_rivlin.hpp"
#include "tunica/materials/viscoelastic.hpp"

namespace {

using namespace tunica;
using materials::Past;
using materials::Viscoelastic;

constexpr double beta = 0.4, tau = 30.0;

const materials::MooneyRivlin elastic(3.0, 0.3);

Viscoelastic law() { return {std::make_unique<materials::MooneyRivlin>(3.0, 0.3), beta, tau}; }

Sym3 sheared(double gamma) { return {1.0, 1.0 + gamma * gamma, 1.0, gamma, 0.0, 0.0}; }

/// Shear stress behind steps on the path γ(t), from rest.
template <class Path>
double shear_stress_after(const Path& gamma, int n, double dt) {
  const Viscoelastic wall = law();
  std::vector<double> state(12, 0.0), next(12);
  double found = 0.0;
  for (int k = 1; k <= n; ++k) {
    const Past past{state.data(), dt};
    found = wall.stress(sheared(gamma(k * dt)), {}, past)[3];
    wall.remember(sheared(gamma(k * dt)), {}, past, next.data());
    state.swap(next);
  }
  return found;
}

TEUCHOS_UNIT_TEST(viscoelastic, a_sudden_stretch_meets_more_stress_which_fades) {
  const double S = elastic.stress(sheared(0.3), {})[3];
  const auto held = [](double) { return 0.3; };
  TEST_FLOATING_EQUALITY(shear_stress_after(held, 1, 1e-9), (1.0 + beta) * S, 1e-8);
  // the stretch is there in the middle of the first step
  for (const int n : {1, 7, 40})
    TEST_FLOATING_EQUALITY(shear_stress_after(held, n, 2.0),
                           S * (1.0 + beta * std::exp(-(n - 0.5) * 2.0 / tau)), 1e-12);
  TEST_FLOATING_EQUALITY(shear_stress_after(held, 100, 1e3), S, 1e-12);
}

TEUCHOS_UNIT_TEST(viscoelastic, follows_the_hereditary_integral_at_second_order) {
  // S = S_e(t) + β ∫ e^(−(t − s)/τ) dS_e(s)
  const auto gamma = [](double t) { return 0.5 * std::sin(t / 20.0); };
  const double end = 50.0;
  const auto elastic_at = [&](double t) { return elastic.stress(sheared(gamma(t)), {})[3]; };
  double exact = elastic_at(end);
  const int fine = 200000;
  for (int k = 0; k < fine; ++k) {
    const double a = end * k / fine, b = end * (k + 1) / fine;
    exact += beta * std::exp((0.5 * (a + b) - end) / tau) * (elastic_at(b) - elastic_at(a));
  }
  const double coarse = shear_stress_after(gamma, 50, 1.0) - exact;
  const double half = shear_stress_after(gamma, 100, 0.5) - exact;
  TEST_FLOATING_EQUALITY(std::log2(coarse / half), 2.0, 0.05);
  TEST_COMPARE(std::abs(half), <, 1e-4 * std::abs(exact));
}

TEUCHOS_UNIT_TEST(viscoelastic, tangent_is_the_derivative_of_the_stress) {
  const Viscoelastic wall = law();
  oracle::Samples samples(5);
  std::vector<double> state;
  for (int k = 0; k < 12; ++k) state.push_back(samples.number(-1.0, 1.0));
  const Past past{state.data(), 4.0};
  const Sym3 C{1.2, 0.9, 1.1, 0.1, -0.2, 0.15};
  const auto at = wall.response(C, {}, past);
  TEST_ASSERT(at.S == wall.stress(C, {}, past));
  for (int J = 0; J < 6; ++J) {
    const double h = 1e-6, dE = J < 3 ? 0.5 * h : h;
    Sym3 up = C, down = C;
    up[J] += h;
    down[J] -= h;
    const Sym3 high = wall.stress(up, {}, past), low = wall.stress(down, {}, past);
    for (int I = 0; I < 6; ++I)
      TEST_COMPARE(std::abs(at.D[I][J] - (high[I] - low[I]) / (2.0 * dE)), <, 1e-7);
  }
}

TEUCHOS_UNIT_TEST(viscoelastic, in_equilibrium_nothing_is_left_of_the_past) {
  const Viscoelastic wall = law();
  const Sym3 C = sheared(0.4);
  TEST_ASSERT(wall.stress(C, {}, {}) == elastic.stress(C, {}));
  std::vector<double> state(12, 7.0);
  wall.remember(C, {}, {}, state.data());
  const Past later{state.data(), 3.0};  // held where it was: no stress beside the elastic one
  TEST_ASSERT(wall.stress(C, {}, later) == elastic.stress(C, {}));
}

TEUCHOS_UNIT_TEST(viscoelastic, a_pack_has_the_values_of_its_points) {
  const Viscoelastic wall = law();
  oracle::Samples samples(6);
  std::vector<double> states;
  for (int k = 0; k < 12 * Pack::size; ++k) states.push_back(samples.number(-1.0, 1.0));
  Sym3Of<Pack> C;
  materials::PackedPast pasts;
  for (int lane = 0; lane < Pack::size; ++lane) {
    set_lane(C, lane, sheared(0.1 * lane));
    pasts[lane] = {states.data() + 12 * lane, 2.0};
  }
  const auto packed = wall.packed_response(C, {}, pasts);
  const Sym3Of<Pack> stress = wall.packed_stress(C, {}, pasts);
  for (int lane = 0; lane < Pack::size; ++lane) {
    const auto one = wall.response(sheared(0.1 * lane), {}, pasts[lane]);
    for (int I = 0; I < 6; ++I) {
      TEST_COMPARE(std::abs(packed.S[I][lane] - one.S[I]), <, 1e-13);
      TEST_COMPARE(std::abs(stress[I][lane] - one.S[I]), <, 1e-13);
      for (int J = 0; J < 6; ++J)
        TEST_COMPARE(std::abs(packed.D[I][J][lane] - one.D[I][J]), <, 1e-12);
    }
  }
}

}  // namespace
