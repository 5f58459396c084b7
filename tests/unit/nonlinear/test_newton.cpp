#include <Teuchos_UnitTestHarness.hpp>

#include "unit/nonlinear/nodewise_problem.hpp"

namespace {

using namespace tunica;
using test::arc_tangent;
using test::NodewiseProblem;
using test::options;
using test::SmallTube;
using test::square_root_of_two;
using test::start;
using test::worst_pressure;

TEUCHOS_UNIT_TEST(newton, converges_quadratically) {
  const SmallTube tube;
  auto problem = square_root_of_two(tube.fluid);
  auto x = start(tube.fluid, 2.0);
  const auto report = nonlinear::solve_newton(problem, options(), x);
  TEST_ASSERT(report.is_converged && report.reason.empty());
  TEST_COMPARE(worst_pressure(x, std::sqrt(2.0)), <, 1e-12);
  TEST_EQUALITY(report.steps.size(), 5u);  // 2, 1.5, 1.41667, 1.414216, 1.41421356237
  TEST_FLOATING_EQUALITY(report.steps[3].exponent, 2.0, 0.05);
  TEST_EQUALITY(report.steps[1].exponent, 0.0);  // three increments are needed
}

TEUCHOS_UNIT_TEST(newton, one_jacobian_for_all_steps_converges_linearly) {
  const SmallTube tube;
  auto problem = square_root_of_two(tube.fluid);
  nonlinear::JacobianRule rule(1e6);
  auto chosen = options();
  for (const auto stop : {nonlinear::StopAt::increment, nonlinear::StopAt::remaining_error}) {
    chosen.stop_at = stop;
    chosen.relative_increment = 0.0;
    chosen.absolute_increment = 1e-7 * problem.increment_norm(test::block_vector(
                                           tube.fluid, [](int, int i) { return i == 3; }));
    auto x = start(tube.fluid, 2.0);
    const auto report = nonlinear::solve_newton(problem, chosen, x, &rule);
    TEST_ASSERT(report.is_converged);
    TEST_FLOATING_EQUALITY(report.steps.back().exponent, 1.0, 0.05);
    // p − (p² − 2)/4 goes to √2 by the part 1 − √2/2 a step, 3/7 of the increment is left behind it
    const double error = worst_pressure(x, std::sqrt(2.0));
    TEST_COMPARE(error, <, 1.1e-7);
    if (stop == nonlinear::StopAt::remaining_error) TEST_COMPARE(error, >, 1e-8);
  }
}

TEUCHOS_UNIT_TEST(newton, steps_report_increment_residual_and_linear_solve) {
  const SmallTube tube;
  auto problem = square_root_of_two(tube.fluid);
  auto x = start(tube.fluid, 2.0);
  const auto report = nonlinear::solve_newton(problem, options(), x);
  const double root_volume =
      problem.increment_norm(test::block_vector(tube.fluid, [](int, int i) { return i == 3; }));
  const double nodes = tube.fluid.node_map->getGlobalNumElements();
  TEST_FLOATING_EQUALITY(report.steps[0].increment, 0.5 * root_volume, 1e-10);
  TEST_EQUALITY(report.steps[0].relative_increment, 1.0);
  TEST_FLOATING_EQUALITY(report.steps[1].relative_increment, 1.0 / 6.0, 1e-10);
  TEST_FLOATING_EQUALITY(report.steps[0].residual, 0.25 * std::sqrt(nodes), 1e-10);
  TEST_EQUALITY(report.steps[0].step_length, 1.0);
  TEST_EQUALITY(report.steps[0].linear.method, "stub");
  TEST_EQUALITY(report.linear_iterations(), 15);
}

TEUCHOS_UNIT_TEST(newton, every_line_search_and_forcing_term_converges) {
  const SmallTube tube;
  for (const std::string search : {"guarded", "decrease", "full step", "backtrack", "polynomial"})
    for (const std::string forcing : {"constant", "type 1", "type 2", "increment"}) {
      auto problem = square_root_of_two(tube.fluid);
      auto chosen = options();
      chosen.line_search = search;
      chosen.forcing.kind = forcing;
      chosen.forcing.tolerance = forcing == "constant" ? 1e-12 : 0.1;
      chosen.forcing.smallest = 1e-10;
      chosen.forcing.largest = 0.1;
      chosen.forcing.scale = 10.0;
      auto x = start(tube.fluid, 2.0);
      const auto report = nonlinear::solve_newton(problem, chosen, x);
      out << search << ", " << forcing << ": " << report.steps.size() << " steps " << report.reason
          << "\n";
      TEST_ASSERT(report.is_converged);
      TEST_COMPARE(worst_pressure(x, std::sqrt(2.0)), <, 1e-7);
    }
}

TEUCHOS_UNIT_TEST(newton, forcing_terms_tighten_the_linear_tolerance) {
  const SmallTube tube;
  for (const std::string forcing : {"type 1", "type 2"}) {
    auto problem = square_root_of_two(tube.fluid);
    auto chosen = options();
    chosen.forcing = {forcing, 0.1, 1e-10, 0.01};
    auto x = start(tube.fluid, 2.0);
    nonlinear::solve_newton(problem, chosen, x);
    TEST_EQUALITY(problem.tolerances().front(), 0.1);
    TEST_COMPARE(problem.tolerances().back(), <, 0.01);
  }
}

TEUCHOS_UNIT_TEST(newton, increments_force_the_square_of_their_size) {
  const SmallTube tube;
  auto problem = square_root_of_two(tube.fluid);
  auto chosen = options();
  chosen.forcing = {"increment", 0.0, 0.0, 0.1, 1.0};
  auto x = start(tube.fluid, 2.0);
  const auto report = nonlinear::solve_newton(problem, chosen, x);
  TEST_ASSERT(report.is_converged);
  TEST_EQUALITY(problem.tolerances()[0], 0.1);
  for (std::size_t k = 1; k < report.steps.size(); ++k) {
    const double e = report.steps[k - 1].relative_increment;
    TEST_FLOATING_EQUALITY(problem.tolerances()[k], std::min(0.1, e * e), 1e-12);
  }
  const auto last = report.steps.size() - 1;
  TEST_COMPARE(report.steps[last].exponent, >, 1.8);  // the order of exact solves
}

TEUCHOS_UNIT_TEST(newton, final_part_keeps_the_last_solves_short) {
  const nonlinear::ForcingOptions paper{"increment", 0.0, 0.0, 0.1, 100.0},
      short_of{"increment", 0.0, 0.0, 0.1, 100.0, 0.1};
  const double stop = 1e-8;
  TEST_FLOATING_EQUALITY(nonlinear::increment_forcing(paper, 1e-7, stop), 1e-10, 1e-12);
  TEST_FLOATING_EQUALITY(nonlinear::increment_forcing(short_of, 1e-7, stop), 0.01, 1e-12);
  TEST_FLOATING_EQUALITY(nonlinear::increment_forcing(short_of, 1e-5, stop), 1e-4, 1e-12);
  TEST_FLOATING_EQUALITY(nonlinear::increment_forcing(paper, 1.0, stop), 0.1, 1e-12);
  TEST_FLOATING_EQUALITY(nonlinear::increment_forcing(short_of, 0.0, stop), 0.1, 1e-12);
}

TEUCHOS_UNIT_TEST(newton, a_start_without_residual_is_reported) {
  const SmallTube tube;
  auto problem = square_root_of_two(tube.fluid);
  problem.refuse_where([](double) { return true; });
  auto x = start(tube.fluid, 2.0);
  const auto report = nonlinear::solve_newton(problem, options(), x);
  TEST_ASSERT(!report.is_converged && report.steps.empty());
  TEST_ASSERT(report.reason.find("at the start: p is out of range") != std::string::npos);
}

TEUCHOS_UNIT_TEST(newton, divergence_is_reported_at_the_growth_limit) {
  const SmallTube tube;
  auto problem = arc_tangent(tube.fluid);
  auto chosen = options();
  chosen.line_search = "full step";
  chosen.growth_limit = 10.0;
  auto x = start(tube.fluid, 2.0);  // full steps alternate and grow beyond 1.39
  const auto report = nonlinear::solve_newton(problem, chosen, x);
  TEST_ASSERT(!report.is_converged);
  TEST_ASSERT(report.reason.find("the increment grew to") == 0);
  TEST_COMPARE(report.steps.back().relative_increment, >, 10.0);
}

TEUCHOS_UNIT_TEST(newton, full_steps_that_lead_away_are_shortened_by_default) {
  const SmallTube tube;
  auto problem = arc_tangent(tube.fluid);
  auto x = start(tube.fluid, 2.0);
  const auto report = nonlinear::solve_newton(problem, options(), x);
  TEST_EQUALITY(options().line_search, "guarded");
  TEST_ASSERT(report.is_converged);
  TEST_COMPARE(report.earlier_steps, >, 0);
  TEST_COMPARE(worst_pressure(x, 0.0), <, 1e-8);

  // Where that does not help either both reasons are told.
  auto short_of = options();
  short_of.max_iterations = 3;
  short_of.growth_limit = 1.5;
  x = start(tube.fluid, 8.0);
  const auto both = nonlinear::solve_newton(problem, short_of, x);
  TEST_ASSERT(!both.is_converged);
  TEST_ASSERT(both.reason.find("the increment grew to") == 0);
  TEST_ASSERT(both.reason.find("; with shorter steps, ") != std::string::npos);
}

TEUCHOS_UNIT_TEST(newton, a_decrease_condition_saves_what_full_steps_lose) {
  const SmallTube tube;
  for (const std::string search : {"backtrack", "polynomial"}) {
    auto problem = arc_tangent(tube.fluid);
    auto chosen = options();
    chosen.line_search = search;
    auto x = start(tube.fluid, 2.0);
    const auto report = nonlinear::solve_newton(problem, chosen, x);
    TEST_ASSERT(report.is_converged);
    TEST_COMPARE(report.steps[0].step_length, <, 1.0);
    TEST_COMPARE(worst_pressure(x, 0.0), <, 1e-8);
  }
}

TEUCHOS_UNIT_TEST(newton, the_cap_is_reported) {
  const SmallTube tube;
  auto problem = square_root_of_two(tube.fluid);
  auto chosen = options();
  chosen.max_iterations = 2;
  auto x = start(tube.fluid, 2.0);
  const auto report = nonlinear::solve_newton(problem, chosen, x);
  TEST_ASSERT(!report.is_converged);
  TEST_EQUALITY(report.steps.size(), 2u);
  TEST_ASSERT(report.reason.find("after 2 iterations") != std::string::npos);
}

TEUCHOS_UNIT_TEST(newton, a_pace_that_cannot_meet_the_cap_may_end_it_early) {
  const SmallTube tube;
  auto chosen = options();
  chosen.relative_increment = 1e-8;
  chosen.tries_again = false;
  chosen.looks_ahead = true;
  for (const int cap : {10, 18}) {
    auto problem = square_root_of_two(tube.fluid);
    nonlinear::JacobianRule rule(1e6);  // each increment is 0.293 of the last: 17 steps to 1e-8
    chosen.max_iterations = cap;
    auto x = start(tube.fluid, 2.0);
    const auto report = nonlinear::solve_newton(problem, chosen, x, &rule);
    TEST_EQUALITY(report.is_converged, cap == 18);
    TEST_EQUALITY(report.is_too_slow, cap == 10);
    if (cap == 10) TEST_EQUALITY(report.steps.size(), 3u);
  }
  auto problem = square_root_of_two(tube.fluid);
  chosen.max_iterations = 8;  // faster than at the pace of its first steps
  auto x = start(tube.fluid, 2.0);
  TEST_ASSERT(nonlinear::solve_newton(problem, chosen, x).is_converged);
}

TEUCHOS_UNIT_TEST(newton, a_failed_linear_solve_is_reported) {
  const SmallTube tube;
  auto problem = square_root_of_two(tube.fluid);
  problem.fail_in_solve(2);
  auto x = start(tube.fluid, 2.0);
  const auto report = nonlinear::solve_newton(problem, options(), x);
  TEST_ASSERT(!report.is_converged);
  TEST_EQUALITY(report.steps.size(), 2u);
  TEST_EQUALITY(report.reason,
                "the linear solver (stub) reached a relative residual of 0.5 "
                "instead of 1e-12 in 3 iterations");
}

TEUCHOS_UNIT_TEST(newton, an_increment_below_the_absolute_limit_is_enough) {
  const SmallTube tube;
  auto problem = square_root_of_two(tube.fluid);
  auto chosen = options();
  chosen.relative_increment = 0.0;
  chosen.absolute_increment = 100.0;
  auto x = start(tube.fluid, 2.0);
  const auto report = nonlinear::solve_newton(problem, chosen, x);
  TEST_ASSERT(report.is_converged);
  TEST_EQUALITY(report.steps.size(), 1u);
}

TEUCHOS_UNIT_TEST(newton, the_increment_that_would_follow_may_be_judged) {
  // From 2 the increments are 0.5, 0.083, 0.0025, the residuals 2, 0.25, 0.007, 6e-6.
  const SmallTube tube;
  const auto steps = [&](double safety) {
    auto problem = square_root_of_two(tube.fluid);
    auto chosen = options();
    chosen.relative_increment = 0.01;
    chosen.stop_at =
        safety > 0.0 ? nonlinear::StopAt::next_increment : nonlinear::StopAt::increment;
    chosen.safety = safety;
    auto x = start(tube.fluid, 2.0);
    const auto report = nonlinear::solve_newton(problem, chosen, x);
    TEST_ASSERT(report.is_converged);
    TEST_COMPARE(worst_pressure(x, std::sqrt(2.0)), <=, 0.01 * 0.5);
    return report.steps.size();
  };
  TEST_EQUALITY(steps(0.0), 3u);
  TEST_EQUALITY(steps(2.0), 2u);
  TEST_EQUALITY(steps(30.0), 3u);
}

TEUCHOS_UNIT_TEST(newton, the_list_says_which_increment_is_judged) {
  Teuchos::ParameterList list;
  list.set("stop at", "next increment").set("safety", 2.0);
  nonlinear::newton_table().resolve(list, "Newton", "");
  TEST_EQUALITY(nonlinear::newton_options(list).safety, 2.0);
  TEST_EQUALITY(options().safety, 0.0);
}

TEUCHOS_UNIT_TEST(newton, a_damped_step_foretells_nothing) {
  const SmallTube tube;
  auto problem = square_root_of_two(tube.fluid);
  problem.refuse_where([](double p) { return p < 1.9998; });
  auto chosen = options();
  chosen.safety = 1e-12;
  auto x = start(tube.fluid, 2.0);
  TEST_ASSERT(!nonlinear::solve_newton(problem, chosen, x).is_converged);
}

TEUCHOS_UNIT_TEST(newton, the_solution_as_start_converges_in_one_step) {
  const SmallTube tube;
  auto problem = arc_tangent(tube.fluid);
  auto x = start(tube.fluid, 0.0);
  const auto report = nonlinear::solve_newton(problem, options(), x);
  TEST_ASSERT(report.is_converged);
  TEST_COMPARE(report.steps.size(), <=, 1u);
}

}  // namespace
