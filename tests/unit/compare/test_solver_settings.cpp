#include <Teuchos_UnitTestHarness.hpp>
#include <cmath>

#include "tunica/compare/solver_table.hpp"
#include "unit/linear/mixed_operator.hpp"

namespace {

using namespace tunica;

compare::SolverSetting setting(const std::string& method, int cap = 0) {
  Teuchos::ParameterList list;
  list.set("method", method);
  if (method != "direct") list.set("preconditioner", "ilu");
  if (cap > 0) list.set("max iterations", cap);
  linear::linear_solver_table().resolve(list, "", "");
  return {method, list};
}

/// A system of the wall and what settings make of it.
struct Bench {
  test::SmallTube tube;
  test::WallJacobian jacobian{tube};
  algebra::BlockVector b = test::scattered(tube.wall, 3, 1.0);
  algebra::BlockVector x;

  compare::SolverRow run(const compare::SolverSetting& with, double tolerance = 1e-10) {
    x = fields::zero_vector(tube.wall);
    return compare::run_setting(with, {"wall", 1, 2, 3, &jacobian.K, &b, &linear::no_operators()},
                                tolerance, x);
  }
};

TEUCHOS_UNIT_TEST(run_setting, settings_that_converge_agree) {
  Bench bench;
  const compare::SolverRow direct = bench.run(setting("direct"));
  const algebra::BlockVector exact = bench.x;
  const compare::SolverRow krylov = bench.run(setting("gmres"));
  TEST_EQUALITY(direct.verdict, "converged");
  TEST_EQUALITY(krylov.verdict, "converged");
  TEST_ASSERT(krylov.field == "wall" && krylov.newton_step == 3 && krylov.method == "gmres");
  TEST_EQUALITY(krylov.preconditioner, "ilu");
  TEST_COMPARE(compare::relative_difference(bench.x, exact), <, 1e-6);
  TEST_COMPARE(std::pow(krylov.convergence_factor(), krylov.solve.iterations), <, 2e-10);
  TEST_ASSERT(krylov.solve.setup_seconds > 0.0 && krylov.solve.solve_seconds > 0.0);
}

TEUCHOS_UNIT_TEST(run_setting, a_cap_is_told_from_the_rest) {
  Bench bench;
  const compare::SolverRow row = bench.run(setting("gmres", 3));
  TEST_EQUALITY(row.verdict, "cap");
  TEST_EQUALITY(row.solve.iterations, 3);
  TEST_ASSERT(!row.solve.is_converged && row.solve.true_residual > 1e-10);
}

TEUCHOS_UNIT_TEST(run_setting, an_exception_becomes_the_verdict) {
  Bench bench;
  bench.jacobian.K.begin_assembly();  // zeros
  bench.jacobian.K.end_assembly();
  const compare::SolverRow row = bench.run(setting("direct"));
  TEST_EQUALITY(row.verdict.rfind("the matrix is singular", 0), 0u);
  TEST_ASSERT(!row.solve.is_converged && std::isnan(row.solve.true_residual));
  TEST_EQUALITY(bench.run(setting("gmres", 5)).solve.is_converged, false);
}

TEUCHOS_UNIT_TEST(relative_difference, is_that_of_the_block_that_differs_more) {
  const test::SmallTube tube;
  algebra::BlockVector x = fields::zero_vector(tube.wall), y = fields::zero_vector(tube.wall);
  y[0].putScalar(1e6);
  y[1].putScalar(2.0);
  x.assign(y);
  TEST_EQUALITY(compare::relative_difference(x, y), 0.0);
  x[1].putScalar(3.0);
  TEST_FLOATING_EQUALITY(compare::relative_difference(x, y), 0.5, 1e-12);
}

TEUCHOS_UNIT_TEST(solver_table, failures_are_marked_and_explained) {
  compare::SolverRow good, bad;
  good.field = bad.field = "wall";
  good.newton_step = bad.newton_step = 1;
  good.setting = "good";
  bad.setting = "a longer name";
  good.solve.is_converged = true;
  good.solve.iterations = 12;
  bad.solve.iterations = 7;
  good.difference = 0.0;
  bad.verdict = "cap";
  const std::string text = compare::text_of({good, bad}, "wall");
  for (const char* part : {"good", "12", "7!", "! Newton step 1, a longer name: cap"})
    TEST_ASSERT(text.find(part) != std::string::npos);
  TEST_EQUALITY(compare::text_of({good, bad}, "fluid"), "");
}

}  // namespace
