#include <Teuchos_Array.hpp>
#include <Teuchos_UnitTestHarness.hpp>
#include <cmath>

#include "tunica/base/error.hpp"
#include "tunica/linear/solvers/stagnation.hpp"
#include "unit/linear/mixed_operator.hpp"
#include "unit/linear/strategies.hpp"

namespace {

using namespace tunica;
using test::SmallTube;

using Names = std::vector<std::string>;

/// Without a preconditioner GCR stagnates on any wall.
Teuchos::ParameterList chain_list(const Names& fallbacks) {
  Teuchos::ParameterList list;
  list.set("preconditioner", "none").set("fallbacks", Teuchos::Array<std::string>(fallbacks));
  linear::linear_solver_table().resolve(list, "Linear Solver", "");
  return list;
}

/// The preconditioners that a solve has tried.
std::vector<std::string> tried(const linear::SolveReport& report) {
  std::vector<std::string> names;
  for (const linear::SolveReport& attempt : report.attempts)
    names.push_back(attempt.preconditioner);
  return names.empty() ? std::vector<std::string>{report.preconditioner} : names;
}

const std::vector<std::string> both = {"none", "direct"};
const std::vector<std::string> the_second = {"direct"};

TEUCHOS_UNIT_TEST(stagnation_rule, gives_up_what_is_slow_and_far_from_its_end) {
  const linear::StagnationRule rule{30, 0.1, 100.0};
  const auto history = [](double factor, int k) {
    std::vector<double> residuals;
    for (int i = 0; i <= k; ++i) residuals.push_back(std::pow(factor, i));
    return residuals;
  };
  // 0.95³⁰ = 0.21: to 1e-8 there are 329 more to come, to 1e-2 60
  TEST_ASSERT(rule.gives_up(history(0.95, 30), 1e-8));
  TEST_ASSERT(!rule.gives_up(history(0.95, 30), 1e-2));
  TEST_ASSERT(!rule.gives_up(history(0.95, 29), 1e-8));   // too early to tell
  TEST_ASSERT(!rule.gives_up(history(0.92, 30), 1e-30));  // 0.92³⁰ = 0.082: fast enough
  TEST_ASSERT(!rule.gives_up(history(0.95, 260), 1e-8));  // 99.1 to come
  TEST_ASSERT(rule.gives_up(history(1.0, 30), 0.5));      // nothing was gained
  TEST_ASSERT(!linear::StagnationRule().gives_up(history(1.0, 300), 1e-8));
  // 0.5: 3.3 iterations a decade, with six to go 20 more; another one of 1 a decade takes 6 and its
  // cost
  TEST_ASSERT((linear::StagnationRule{5, 0.0, 4.0, 1.0}.gives_up(history(0.5, 7), 1e-8)));
  TEST_ASSERT((!linear::StagnationRule{5, 0.0, 14.0, 1.0}.gives_up(history(0.5, 7), 1e-8)));
  TEST_ASSERT((!linear::StagnationRule{5, 0.0, 4.0, 3.0}.gives_up(history(0.5, 7), 1e-8)));
}

TEUCHOS_UNIT_TEST(solver_chain, takes_the_next_preconditioner_where_one_stagnates) {
  const SmallTube tube;
  const test::WallJacobian jacobian(tube);
  const auto b = test::scattered(tube.wall, 1);
  for (const Names& fallbacks : {Names{"direct"}, Names{"vanka"}, Names{"ilu", "direct"}}) {
    const auto solver = linear::make_linear_solver(chain_list(fallbacks), jacobian.K);
    solver->matrix_changed();
    auto x = test::scattered(tube.wall, 7);  // the start must not matter
    const auto report = solver->solve(b, x, 1e-8);
    TEST_ASSERT(report.is_converged);
    TEST_EQUALITY(report.preconditioner, fallbacks[0]);
    TEST_EQUALITY(report.attempts.size(), 2);
    TEST_ASSERT(report.attempts[0].has_stagnated && !report.attempts[0].is_converged);
    TEST_COMPARE(report.attempts[0].iterations, <, 60);
    TEST_EQUALITY(report.iterations, report.attempts[0].iterations + report.attempts[1].iterations);
    algebra::BlockVector Kx = jacobian.K.zero();
    jacobian.K.apply(x, Kx);
    TEST_COMPARE(test::relative_difference(Kx, b), <, 2.1e-8);
  }
}

TEUCHOS_UNIT_TEST(solver_chain, keeps_it_for_more_and_more_steps) {
  const SmallTube tube;
  const test::WallJacobian jacobian(tube);
  const auto b = test::scattered(tube.wall, 1);
  const auto list = chain_list({"direct"});
  auto solver = linear::make_linear_solver(list, jacobian.K);
  algebra::BlockVector x = fields::zero_vector(tube.wall), other = fields::zero_vector(tube.wall);
  TEST_ASSERT(solver->save().empty());
  for (int step = 1; step <= 12; ++step) {
    solver->forget();
    solver->matrix_changed();
    const auto first = solver->solve(b, x, 1e-8);
    TEST_ASSERT(first.is_converged);
    // The first one is tried in steps 1, 3, 6 and 11: it waits for 1, 2, 4 steps.
    const bool is_trial = step == 1 || step == 3 || step == 6 || step == 11;
    TEST_ASSERT(tried(first) == (is_trial ? both : the_second));
    TEST_ASSERT(tried(solver->solve(b, other, 1e-8)) == the_second);  // within the step
    // What a checkpoint keeps makes another solver go on alike, to the last digit.
    auto twin = linear::make_linear_solver(list, jacobian.K);
    twin->restore(solver->save());
    twin->matrix_changed();
    solver = std::move(twin);
  }
}

TEUCHOS_UNIT_TEST(solver_chain, solves_alike_after_a_restart) {
  const SmallTube tube;
  const test::WallJacobian jacobian(tube);
  const auto b = test::scattered(tube.wall, 1);
  const auto list = chain_list({"vanka"});
  const auto solver = linear::make_linear_solver(list, jacobian.K);
  const auto twin = linear::make_linear_solver(list, jacobian.K);
  algebra::BlockVector x = fields::zero_vector(tube.wall), y = fields::zero_vector(tube.wall);
  solver->matrix_changed();
  solver->solve(b, x, 1e-8);
  twin->restore(solver->save());
  for (linear::LinearSolver* one : {solver.get(), twin.get()}) {
    one->forget();
    one->matrix_changed();
  }
  const auto straight = solver->solve(b, x, 1e-8), restarted = twin->solve(b, y, 1e-8);
  TEST_EQUALITY(straight.iterations, restarted.iterations);
  TEST_EQUALITY(test::relative_difference(x, y), 0.0);
}

TEUCHOS_UNIT_TEST(solver_chain, goes_on_to_the_cap_where_no_other_can_serve) {
  const SmallTube tube;
  const test::WallJacobian jacobian(tube);
  const auto b = test::scattered(tube.wall, 1);
  auto list = chain_list({"direct"});
  list.set("max iterations", 70);
  algebra::BlockVector x = fields::zero_vector(tube.wall);
  auto few = list, small = list;
  few.set("direct unknowns", 1);
  small.set("direct memory", 1e-9);
  // Unknowns are known at once, the size of factors when somebody asks for them.
  for (const auto& [limited, attempts] : {std::pair(few, 1), std::pair(small, 2)}) {
    const auto solver = linear::make_linear_solver(limited, jacobian.K);
    solver->matrix_changed();
    const auto report = solver->solve(b, x, 1e-8);
    TEST_ASSERT(!report.is_converged);
    TEST_EQUALITY(report.preconditioner, "none");
    TEST_EQUALITY(static_cast<int>(tried(report).size()), attempts);
    TEST_EQUALITY(attempts == 1 ? report.iterations : report.attempts.back().iterations, 70);
  }
}

TEUCHOS_UNIT_TEST(solver_chain, a_breakdown_is_followed_by_the_next) {
  const SmallTube tube;
  const test::WallJacobian jacobian(tube);
  const auto b = test::scattered(tube.wall, 1);
  Teuchos::ParameterList list;
  list.set("preconditioner", "multigrid")
      .set("fallbacks", Teuchos::Array<std::string>(Names{"direct"}));
  list.sublist("MueLu") = multigrid::vanka_cycle_list(1);
  list.sublist("MueLu").sublist("Factories").sublist("Sweeps").set("damping", 1e300);
  list.sublist("MueLu").sublist("Hierarchy").set("coarse: max size", 100);
  linear::linear_solver_table().resolve(list, "Linear Solver", "");
  const auto solver = linear::make_linear_solver(list, jacobian.K);
  algebra::BlockVector x = fields::zero_vector(tube.wall);
  solver->matrix_changed();
  const auto report = solver->solve(b, x, 1e-8);
  TEST_ASSERT(report.is_converged);
  TEST_EQUALITY(report.preconditioner, "direct");
}

TEUCHOS_UNIT_TEST(solver_chain, a_cycle_that_stagnates_tries_rotations_first) {
  const SmallTube tube;
  const std::size_t n_regions = tube.wall.regions.size();
  const test::WallJacobian jacobian(
      tube, {{"wall", "between"}, std::vector<int>(n_regions, 0), std::vector<char>(n_regions, 1)});
  const auto b = test::scattered(tube.wall, 3);
  const auto solved = [&](double rotations_from) {
    Teuchos::ParameterList list;
    list.set("preconditioner", "multigrid").set("max iterations", 8);
    list.sublist("MueLu") = multigrid::mixed_cycle_list(1, "power", rotations_from);
    list.sublist("MueLu").sublist("Factories").sublist("Nodes").set("rotations", true);
    list.sublist("MueLu").sublist("Hierarchy").set("coarse: max size", 40);
    linear::linear_solver_table().resolve(list, "Linear Solver", "");
    const auto solver = linear::make_linear_solver(list, jacobian.K);
    algebra::BlockVector x(jacobian.K.space());
    solver->matrix_changed();
    return solver->solve(b, x, 1e-14);
  };
  TEST_EQUALITY(solved(0.999).iterations, 8);  // fast enough
  const auto report = solved(1e-6);
  TEST_COMPARE(report.iterations, >, 8);
  TEST_COMPARE(report.true_residual, <, solved(0.999).true_residual);
}

TEUCHOS_UNIT_TEST(solver_chain, an_unknown_name_in_the_list_is_an_error) {
  Teuchos::ParameterList list;
  list.set("fallbacks", Teuchos::Array<std::string>(Names{"vanka", "indirect"}));
  TEST_THROW(linear::linear_solver_table().resolve(list, "Linear Solver", ""), Error);
}

TEUCHOS_UNIT_TEST(solver_chain, a_slow_solve_is_given_up_where_that_is_wanted) {
  const SmallTube tube;
  test::WallJacobian jacobian(tube);
  jacobian.set(0.005);
  const auto b = test::scattered(tube.wall, 1);
  std::vector<int> iterations;
  for (const int most_to_come : {0, 2000, 50}) {
    Teuchos::ParameterList list;
    list.set("preconditioner", "none").set("max iterations", 1000).set("restart", 500);
    list.set("give up at", most_to_come);
    linear::linear_solver_table().resolve(list, "Linear Solver", "");
    const auto solver = linear::make_linear_solver(list, jacobian.K);
    solver->matrix_changed();
    algebra::BlockVector x = fields::zero_vector(tube.wall);
    const auto report = solver->solve(b, x, 1e-8);
    TEST_EQUALITY(report.has_stagnated, most_to_come == 50);
    TEST_EQUALITY(report.is_converged, most_to_come != 50);
    iterations.push_back(report.iterations);
  }
  TEST_COMPARE(iterations[0], >, 70);
  TEST_EQUALITY(iterations[1], iterations[0]);
  TEST_EQUALITY(iterations[2], 20);
}

}  // namespace
