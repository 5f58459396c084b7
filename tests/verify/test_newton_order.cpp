// Newton's method with exact Jacobians: log(e_k/e_{k−1}) / log(e_{k−1}/e_{k−2}) of the
// increments e tends to 2, until round-off.

#include <Teuchos_UnitTestHarness.hpp>

#include "fluid_on_cube.hpp"
#include "quarter_tube.hpp"
#include "tunica/problems/solid_problem.hpp"
#include "tunica/setup/case.hpp"
#include "tunica/setup/schema.hpp"

namespace {

using namespace tunica;

/// Exponent of the last step above round-off, where convergence has been seen.
double last_exponent(const nonlinear::NewtonReport& report, std::ostream& out) {
  double exponent = 0.0;
  for (const nonlinear::NewtonStep& step : report.steps) {
    out << "increment " << step.increment << ", relative " << step.relative_increment
        << ", exponent " << step.exponent << "\n";
    if (step.relative_increment > 1e-11) exponent = step.exponent;
  }
  return exponent;
}

TEUCHOS_UNIT_TEST(newton, converges_quadratically_on_an_inflated_wall) {
  setup::CommandLine command;
  command.case_file = TUNICA_CASES "/inflation.xml";
  Teuchos::ParameterList list =
      setup::read_case(command, setup::solid_table(), *Tpetra::getDefaultComm()).list;
  list.sublist("Wall").sublist("Newton").set("relative increment", 1e-12);
  list.sublist("Wall").sublist("Newton").set("absolute increment", 0.0);
  list.sublist("Wall").set("stabilisation residual", std::string("linear"));  // F that stays
  const fields::FieldMesh field = verify::field_of(verify::make_quarter_tube(1));
  problems::SolidProblem wall(list.sublist("Wall"), field);
  wall.begin_step(stepping::Clock(5.0, 1));  // 0.5 kPa at once
  const nonlinear::NewtonReport report = wall.solve();
  TEST_ASSERT(report.is_converged);
  TEST_COMPARE(report.steps.size(), >=, 4u);
  TEST_COMPARE(last_exponent(report, out), >=, 1.8);
}

TEUCHOS_UNIT_TEST(newton, converges_quadratically_on_a_convective_flow) {
  // A driven cavity from rest in one step that is long against the time of convection; Re 100.
  using verify::entry;
  const fields::FieldMesh field = verify::field_of(verify::make_cube(6));
  problems::FluidProblem fluid(
      verify::enclosed_fluid(1.0, 0.01,
                             entry("relative increment", "double", "1e-12") +
                                 entry("absolute increment", "double", "0") +
                                 entry("linear tolerance", "double", "1e-11")),
      field);
  fluid.field().set_boundary_velocity([](const Vec3& x, double) {
    const double lid = x[2] > 0.999 ? 16.0 * x[0] * (1.0 - x[0]) * x[1] * (1.0 - x[1]) : 0.0;
    return Vec3{lid, 0.3 * lid, 0.0};
  });
  const stepping::Clock clock(2.0, 1);
  fluid.begin_step(clock);
  const nonlinear::NewtonReport report = fluid.solve();
  TEST_ASSERT(report.is_converged);
  TEST_COMPARE(report.steps.size(), >=, 4u);
  TEST_COMPARE(last_exponent(report, out), >=, 1.8);
}

}  // namespace
