// A quarter of a tube under an inner pressure that rises smoothly, in time steps of Δt, Δt/2 and
// Δt/4: |d(Δt) − d(Δt/2)| / |d(Δt/2) − d(Δt/4)| tends to 2^order. The stabilisation without
// inertia does not depend on Δt, so that the semi-discrete problem is the same for all three.

#include <Teuchos_UnitTestHarness.hpp>

#include "field_of.hpp"
#include "quarter_tube.hpp"
#include "tunica/base/error.hpp"
#include "tunica/problems/solid_problem.hpp"
#include "tunica/setup/case.hpp"
#include "tunica/setup/schema.hpp"

namespace {

using namespace tunica;

constexpr double duration = 4.0;  // of the rise [ms]

/// sin² from 0 to 1, dense enough for linear interpolation not to be seen.
std::string smooth_rise() {
  std::ostringstream times, values;
  times << "{0";
  values << "{0";
  for (int i = 1; i <= 4000; ++i) {
    times << "," << duration * i / 4000.0;
    values << "," << std::pow(std::sin(std::acos(0.0) * i / 4000.0), 2);
  }
  return verify::entry("kind", "string", "table") +
         verify::entry("times", "Array(double)", times.str() + "}") +
         verify::entry("values", "Array(double)", values.str() + "}");
}

std::string dynamic_wall(const std::string& scheme, const std::string& beta,
                         const std::string& gamma) {
  using verify::entry;
  using verify::sublist;
  const auto held = [](const std::string& component) {
    return entry("condition", "string", "held") +
           entry("components", "Array(string)", "{" + component + "}");
  };
  const std::string layer = entry("law", "string", "mooney-rivlin");
  return sublist("Layers", sublist("media", layer) + sublist("adventitia", layer)) +
         sublist("Surfaces",
                 sublist("interface", entry("condition", "string", "pressure") +
                                          entry("pressure", "double", "0.3") +
                                          sublist("Amplitude", smooth_rise())) +
                     sublist("struct_in", held("z")) + sublist("struct_out", held("z")) +
                     sublist("symmetry_x", held("x")) + sublist("symmetry_y", held("y"))) +
         entry("stabilisation", "string", "paper") + entry("time scheme", "string", scheme) +
         sublist("Newmark", entry("beta", "double", beta) + entry("gamma", "double", gamma)) +
         sublist("Newton", entry("relative increment", "double", "1e-11")) +
         sublist("Linear Solver", entry("method", "string", "direct"));
}

/// Displacement at the end of the rise.
std::vector<Vec3> displacement(const Teuchos::ParameterList& list, const fields::FieldMesh& field,
                               int steps) {
  problems::SolidProblem wall(list, field);
  for (stepping::Clock clock(duration / steps, steps); !clock.is_done(); clock.advance()) {
    wall.begin_step(clock);
    const nonlinear::NewtonReport report = wall.solve();
    TUNICA_CHECK(report.is_converged, report.reason);
    wall.end_step();
  }
  return wall.displacement();
}

double order_in_time(const std::string& scheme, const std::string& beta, const std::string& gamma,
                     int steps, std::ostream& out) {
  const fields::FieldMesh field = verify::field_of(verify::make_quarter_tube(1));
  const Teuchos::ParameterList list =
      verify::resolved(problems::solid_table(), dynamic_wall(scheme, beta, gamma));
  std::vector<std::vector<Vec3>> d;
  for (const int factor : {1, 2, 4}) d.push_back(displacement(list, field, factor * steps));
  out << "differences " << verify::distance(d[0], d[1]) << " " << verify::distance(d[1], d[2])
      << "\n";
  return verify::order(verify::distance(d[0], d[1]), verify::distance(d[1], d[2]));
}

TEUCHOS_UNIT_TEST(wall_dynamics, newmark_with_gamma_one_half_is_of_second_order) {
  TEST_FLOATING_EQUALITY(order_in_time("newmark", "0.25", "0.5", 40, out), 2.0, 0.05);
}

TEUCHOS_UNIT_TEST(wall_dynamics, bdf2_is_of_second_order) {
  TEST_FLOATING_EQUALITY(order_in_time("bdf2", "0.25", "0.5", 80, out), 2.0, 0.1);
}

TEUCHOS_UNIT_TEST(wall_dynamics, newmark_with_gamma_one_is_of_first_order) {
  TEST_FLOATING_EQUALITY(order_in_time("newmark", "0.625", "1", 120, out), 1.0, 0.1);
}

}  // namespace
