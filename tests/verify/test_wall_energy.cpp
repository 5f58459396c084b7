// A quarter of a tube after a smooth pulse of inner pressure: no force does work any more, so
// that kinetic, elastic and volumetric energy together stay but for what the time scheme makes
// of them. Newmark with γ = 1/2, β = 1/4 makes them waver by Δt², γ = 1 takes out Δt. The inertial
// τ ~ Δt² leaves nothing of PSPG in the limit. κ is moderate because γ = 1/2 lets the pressure of a
// nearly incompressible wall oscillate more and more.

#include <Teuchos_UnitTestHarness.hpp>

#include "field_of.hpp"
#include "quarter_tube.hpp"
#include "tunica/base/error.hpp"
#include "tunica/problems/solid_problem.hpp"

namespace {

using namespace tunica;

constexpr double pulse = 2.0, end = 6.0;  // [ms]

/// sin² from 0 to 1 and back.
std::string smooth_pulse() {
  std::ostringstream times, values;
  for (int i = 0; i <= 2000; ++i) {
    times << (i > 0 ? "," : "{") << pulse * i / 2000.0;
    values << (i > 0 ? "," : "{") << std::pow(std::sin(std::acos(-1.0) * i / 2000.0), 2);
  }
  return verify::entry("kind", "string", "table") +
         verify::entry("times", "Array(double)", times.str() + "}") +
         verify::entry("values", "Array(double)", values.str() + "}");
}

std::string vibrating_wall(const std::string& beta, const std::string& gamma,
                           const std::string& bulk_modulus) {
  using verify::entry;
  using verify::sublist;
  const auto held = [](const std::string& component) {
    return entry("condition", "string", "held") +
           entry("components", "Array(string)", "{" + component + "}");
  };
  const std::string layer =
      entry("law", "string", "mooney-rivlin") + entry("bulk modulus", "double", bulk_modulus);
  return sublist("Layers", sublist("media", layer) + sublist("adventitia", layer)) +
         sublist("Surfaces",
                 sublist("interface", entry("condition", "string", "pressure") +
                                          entry("pressure", "double", "0.5") +
                                          sublist("Amplitude", smooth_pulse())) +
                     sublist("struct_in", held("z")) + sublist("struct_out", held("z")) +
                     sublist("symmetry_x", held("x")) + sublist("symmetry_y", held("y"))) +
         entry("time scheme", "string", "newmark") +
         sublist("Newmark", entry("beta", "double", beta) + entry("gamma", "double", gamma)) +
         sublist("Newton", entry("relative increment", "double", "1e-11")) +
         sublist("Linear Solver", entry("method", "string", "direct"));
}

double energy_of(const problems::SolidProblem& wall) {
  double sum = 0.0;
  for (const discretisation::Observable& o : wall.observe())
    if (o.name.find("energy") != std::string::npos) sum += o.value;
  return sum;
}

double observed(const problems::SolidProblem& wall, const std::string& name) {
  for (const discretisation::Observable& o : wall.observe())
    if (o.name == name) return o.value;
  throw Error(name + ": no such observable");
}

struct Drift {
  double largest = 0.0;  ///< deviation from the energy at the end of the pulse, relative
  double last = 0.0;     ///< what is lost at the end, relative
};

Drift drift_of(const std::string& beta, const std::string& gamma, int steps, std::ostream& out,
               const std::string& bulk_modulus = "20") {
  const fields::FieldMesh field = verify::field_of(verify::make_quarter_tube(1));
  problems::SolidProblem wall(
      verify::resolved(problems::solid_table(), vibrating_wall(beta, gamma, bulk_modulus)), field);
  double reference = 0.0, on_subscales = 0.0, last_power = 0.0;
  Drift drift;
  for (stepping::Clock clock(end / steps, steps); !clock.is_done(); clock.advance()) {
    wall.begin_step(clock);
    const nonlinear::NewtonReport report = wall.solve();
    TUNICA_CHECK(report.is_converged, report.reason);
    wall.end_step();
    const double power = observed(wall, "wall_stabilisation_power_kPa_mm3_per_ms");
    on_subscales += 0.5 * clock.step_size() * (last_power + power);
    last_power = power;
    if (clock.time() < pulse - 1e-9) continue;
    const double energy = energy_of(wall) + on_subscales;
    if (reference == 0.0) reference = energy;
    drift.last = 1.0 - energy / reference;
    drift.largest = std::max(drift.largest, std::abs(drift.last));
  }
  out << steps << " steps: energy " << reference << " kPa mm^3, largest drift " << drift.largest
      << ", lost " << drift.last << "\n";
  return drift;
}

TEUCHOS_UNIT_TEST(wall_energy, newmark_with_gamma_one_half_keeps_it_to_second_order) {
  double last = 0.0;
  for (const int steps : {60, 120, 240}) {
    const double drift = drift_of("0.25", "0.5", steps, out).largest;
    if (last > 0.0) TEST_FLOATING_EQUALITY(verify::order(last, drift), 2.0, 0.1);
    last = drift;
  }
  TEST_COMPARE(last, <, 1e-3);
}

TEUCHOS_UNIT_TEST(wall_energy, subscales_keep_that_of_a_nearly_incompressible_wall) {
  // What the pressure does on the subscales is counted. Without inertia of theirs the wall gains
  // energy without bound from 960 steps on.
  double last = 0.0;
  for (const int steps : {60, 240, 960}) {
    const double drift = drift_of("0.25", "0.5", steps, out, "1e5").largest;
    if (last > 0.0) TEST_COMPARE(drift, <, 0.5 * last);
    last = drift;
  }
  TEST_COMPARE(last, <, 5e-4);
}

TEUCHOS_UNIT_TEST(wall_energy, newmark_with_gamma_one_loses_it_to_first_order) {
  double last = 0.0;
  for (const int steps : {240, 480, 960}) {
    const double lost = drift_of("0.625", "1", steps, out).last;
    TEST_COMPARE(lost, >, 0.0);
    if (last > 0.0) TEST_FLOATING_EQUALITY(verify::order(last, lost), 1.0, 0.15);
    last = lost;
  }
}

}  // namespace
