#include <Teuchos_UnitTestHarness.hpp>

#include "unit/nonlinear/nodewise_problem.hpp"

namespace {

using namespace tunica;
using test::arc_tangent;
using test::logarithm;
using test::NodewiseProblem;
using test::options;
using test::SmallTube;
using test::square_root_of_two;
using test::start;
using test::worst_pressure;

TEUCHOS_UNIT_TEST(line_search, guarded_line_search_halves_where_the_residual_refuses) {
  // From 4 the full step of log p leads to −1.545, half of it to 1.227.
  const SmallTube tube;
  auto problem = logarithm(tube.fluid);
  problem.refuse_where([](double p) { return p <= 0.0; });
  auto x = start(tube.fluid, 4.0);
  const auto report = nonlinear::solve_newton(problem, options(), x);
  TEST_ASSERT(report.is_converged);
  TEST_EQUALITY(report.steps[0].step_length, 0.5);
  TEST_EQUALITY(report.steps[1].step_length, 1.0);
  TEST_COMPARE(worst_pressure(x, 1.0), <, 1e-10);
}

TEUCHOS_UNIT_TEST(line_search, a_damped_step_does_not_pass_for_convergence) {
  // From 2 towards √2, but nothing below 1.9998 is admissible: steps of 1/4096 of the way.
  const SmallTube tube;
  auto problem = square_root_of_two(tube.fluid);
  problem.refuse_where([](double p) { return p < 1.9998; });
  auto chosen = options();
  chosen.absolute_increment = 0.1 * problem.increment_norm(start(tube.fluid, 0.5));
  auto x = start(tube.fluid, 2.0);
  const auto report = nonlinear::solve_newton(problem, chosen, x);
  TEST_ASSERT(!report.is_converged);
  TEST_COMPARE(report.steps[0].step_length, <, 1e-3);
  TEST_COMPARE(report.steps[0].increment, >, chosen.absolute_increment);
}

TEUCHOS_UNIT_TEST(line_search, guarded_line_search_halves_where_the_residual_is_no_number) {
  const SmallTube tube;
  auto problem = logarithm(tube.fluid);  // log of −1.545 is NaN
  auto x = start(tube.fluid, 4.0);
  const auto report = nonlinear::solve_newton(problem, options(), x);
  TEST_ASSERT(report.is_converged);
  TEST_EQUALITY(report.steps[0].step_length, 0.5);
}

TEUCHOS_UNIT_TEST(line_search, guarded_line_search_halves_where_the_residual_grows_a_thousandfold) {
  const SmallTube tube;
  auto problem = square_root_of_two(tube.fluid);
  auto x = start(tube.fluid, 1e-3);  // from there to 1000, 62 and 31: f = 1e6, 3904 and 974 from 2
  const auto report = nonlinear::solve_newton(problem, options(), x);
  TEST_ASSERT(report.is_converged);
  TEST_EQUALITY(report.steps[0].step_length, 1.0 / 32.0);
  TEST_EQUALITY(report.steps[1].step_length, 1.0);
  TEST_COMPARE(worst_pressure(x, std::sqrt(2.0)), <, 1e-8);
}

TEUCHOS_UNIT_TEST(line_search, an_old_jacobian_that_leads_away_is_not_used_again) {
  const SmallTube tube;
  const auto cube = [](double p) { return p * p * p - 8.0; };
  NodewiseProblem problem(tube.fluid, cube, [](double p) { return 3.0 * p * p; });
  auto chosen = options();
  chosen.tries_again = false;
  auto x = start(tube.fluid, 0.5);  // to 11, and from there with the slope 3/4 anywhere
  nonlinear::JacobianRule rule(1e6);
  const auto report = nonlinear::solve_newton(problem, chosen, x, &rule);
  TEST_ASSERT(report.is_converged);
  TEST_EQUALITY(report.earlier_steps, 2);
  TEST_ASSERT(rule.has_led_away());
  TEST_COMPARE(worst_pressure(x, 2.0), <, 1e-8);
}

TEUCHOS_UNIT_TEST(line_search, steps_are_shortened_until_the_residual_falls) {
  // Newton's method for atan p = 0 swings further out from p > 1.39; halved steps come home, also
  // where points far out are not admissible.
  const SmallTube tube;
  for (const bool has_limits : {false, true}) {
    auto problem = arc_tangent(tube.fluid);
    if (has_limits) problem.refuse_where([](double p) { return p < -3.0; });
    auto chosen = options();
    chosen.line_search = "decrease";
    auto x = start(tube.fluid, 4.0);
    const auto report = nonlinear::solve_newton(problem, chosen, x);
    TEST_ASSERT(report.is_converged);
    TEST_COMPARE(report.steps.front().step_length, <, 1.0);
    TEST_COMPARE(worst_pressure(x, 0.0), <, 1e-8);
  }
}

TEUCHOS_UNIT_TEST(line_search, a_direction_without_admissible_step_is_reported) {
  const SmallTube tube;
  auto problem = square_root_of_two(tube.fluid);
  problem.refuse_where([](double p) { return p < 2.0; });
  auto x = start(tube.fluid, 2.0);
  const auto report = nonlinear::solve_newton(problem, options(), x);
  TEST_ASSERT(!report.is_converged);
  TEST_EQUALITY(report.reason, "no admissible step along the Newton direction: p is out of range");
  TEST_COMPARE(worst_pressure(x, 2.0), <, 1e-15);  // the start is kept
}

TEUCHOS_UNIT_TEST(line_search, a_line_search_that_finds_no_step_is_named) {
  const SmallTube tube;
  for (const std::string search : {"backtrack", "polynomial"}) {
    auto problem = square_root_of_two(tube.fluid);
    problem.refuse_where([](double p) { return p < 2.0; });
    auto chosen = options();
    chosen.line_search = search;
    auto x = start(tube.fluid, 2.0);
    const auto report = nonlinear::solve_newton(problem, chosen, x);
    TEST_ASSERT(!report.is_converged);
    TEST_EQUALITY(report.reason,
                  "no step with the line search \"" + search + "\": p is out of range");
  }
}

}  // namespace
