#include <Teuchos_UnitTestHarness.hpp>

#include "tunica/base/trilinos.hpp"
#include "tunica/linear/direct/direct_factor.hpp"
#include "unit/linear/mixed_operator.hpp"
#include "unit/linear/strategies.hpp"

namespace {

using namespace tunica;
using test::SmallTube;

Teuchos::ParameterList resolved(const std::vector<std::pair<std::string, std::string>>& choices,
                                const std::vector<std::pair<std::string, int>>& numbers = {}) {
  Teuchos::ParameterList list;
  list.set("preconditioner", "ilu");
  for (const auto& [name, value] : choices) list.set(name, value);
  if (list.get<std::string>("method") == "direct") list.remove("preconditioner");
  for (const auto& [name, value] : numbers) list.set(name, value);
  linear::linear_solver_table().resolve(list, "Linear Solver", "");
  return list;
}

double true_error(const fields::BlockOperator& K, const algebra::BlockVector& b,
                  const algebra::BlockVector& x) {
  algebra::BlockVector Kx = K.zero();
  K.apply(x, Kx);
  return test::relative_difference(Kx, b);
}

TEUCHOS_UNIT_TEST(linear_solver, every_method_and_preconditioner_solves_a_real_jacobian) {
  const SmallTube tube;
  test::WallJacobian jacobian(tube);
  jacobian.set(0.005);
  const auto b = test::scattered(tube.wall, 1);
  std::vector<Teuchos::ParameterList> lists{resolved({{"method", "direct"}})};
  for (const std::string method : {"flexible gmres", "gmres", "bicgstab"})
    for (const std::string preconditioner : {"ilu", "direct"})
      lists.push_back(resolved({{"method", method}, {"preconditioner", preconditioner}}));
  for (const std::string method : {"flexible gmres", "gmres"})
    lists.push_back(resolved({{"method", method}, {"preconditioner", "none"}}, {{"restart", 500}}));
  lists.push_back(resolved({{"method", "gmres"}}, {{"fill level", 1}, {"overlap", 1}}));
  lists.push_back(resolved({{"method", "flexible gmres"}}, {{"restart", 20}}));
  for (auto& list : lists) {
    list.set("max iterations", 1000);
    const auto solver = linear::make_linear_solver(list, jacobian.K);
    solver->matrix_changed();
    auto x = test::scattered(tube.wall, 7);  // the start must not matter
    const auto report = solver->solve(b, x, 1e-8);
    out << report.method << ": " << report.iterations << " iterations, " << report.true_residual
        << "\n";
    TEST_ASSERT(report.is_converged);
    TEST_COMPARE(true_error(jacobian.K, b, x), <, 2.1e-8);
    TEST_FLOATING_EQUALITY(report.true_residual + 1.0, true_error(jacobian.K, b, x) + 1.0, 1e-10);
    TEST_EQUALITY(report.tolerance, 1e-8);
  }
}

TEUCHOS_UNIT_TEST(linear_solver, a_method_that_stagnates_says_so) {
  const SmallTube tube;
  const test::WallJacobian jacobian(tube);
  const auto b = test::scattered(tube.wall, 1);
  const auto solver = linear::make_linear_solver(
      resolved({{"method", "bicgstab"}, {"preconditioner", "none"}}, {{"max iterations", 40}}),
      jacobian.K);
  solver->matrix_changed();
  algebra::BlockVector x = fields::zero_vector(tube.wall);
  const auto report = solver->solve(b, x, 1e-8);
  TEST_ASSERT(!report.is_converged);
  TEST_COMPARE(report.true_residual, >, 2e-8);
  TEST_EQUALITY(report.iterations, 40);
}

TEUCHOS_UNIT_TEST(linear_solver, a_cap_of_one_iteration_is_reported_as_not_converged) {
  const SmallTube tube;
  const test::WallJacobian jacobian(tube);
  const auto b = test::scattered(tube.wall, 1);
  for (const std::string method : {"flexible gmres", "gmres", "bicgstab"}) {
    const auto solver = linear::make_linear_solver(
        resolved({{"method", method}}, {{"max iterations", 1}}), jacobian.K);
    solver->matrix_changed();
    algebra::BlockVector x = fields::zero_vector(tube.wall);
    const auto report = solver->solve(b, x, 1e-8);
    TEST_ASSERT(!report.is_converged);
    TEST_EQUALITY(report.iterations, 1);
    TEST_COMPARE(report.true_residual, >, 1e-8);
  }
}

TEUCHOS_UNIT_TEST(linear_solver, a_zero_right_side_has_the_zero_solution) {
  const SmallTube tube;
  const test::WallJacobian jacobian(tube);
  for (const std::string method : {"direct", "gmres"}) {
    const auto solver = linear::make_linear_solver(resolved({{"method", method}}), jacobian.K);
    solver->matrix_changed();
    auto x = test::scattered(tube.wall, 7);
    const auto report = solver->solve(fields::zero_vector(tube.wall), x, 1e-8);
    TEST_ASSERT(report.is_converged);
    TEST_EQUALITY(test::norm(x), 0.0);
  }
}

TEUCHOS_UNIT_TEST(linear_solver, factors_are_kept_while_the_matrix_hardly_changes) {
  const SmallTube tube;
  test::WallJacobian jacobian(tube);
  const auto b = test::scattered(tube.wall, 1);
  const auto solver = linear::make_linear_solver(
      resolved({{"method", "flexible gmres"}, {"preconditioner", "direct"}}), jacobian.K);
  algebra::BlockVector x = fields::zero_vector(tube.wall);
  solver->matrix_changed();
  TEST_ASSERT(solver->solve(b, x, 1e-8).setup_seconds > 0.0);
  jacobian.set(1e-5);
  solver->matrix_changed();
  const auto kept = solver->solve(b, x, 1e-8);
  TEST_ASSERT(kept.is_converged);
  TEST_COMPARE(kept.iterations, >, 1);                    // new factors need one
  TEST_COMPARE(true_error(jacobian.K, b, x), <, 2.1e-8);  // the new matrix, old factors
}

TEUCHOS_UNIT_TEST(linear_solver, kept_factors_are_renewed_when_they_have_become_too_weak) {
  const SmallTube tube;
  test::WallJacobian jacobian(tube);
  const auto b = test::scattered(tube.wall, 1);
  auto list = resolved({{"method", "flexible gmres"}, {"preconditioner", "direct"}});
  list.set("refresh factor", 0.02);
  const auto solver = linear::make_linear_solver(list, jacobian.K);
  algebra::BlockVector x = fields::zero_vector(tube.wall);
  std::vector<linear::SolveReport> reports;
  for (const double size : {0.0, 0.01, 0.01}) {
    jacobian.set(size);
    solver->matrix_changed();
    reports.push_back(solver->solve(b, x, 1e-8));
    TEST_ASSERT(reports.back().is_converged);
  }
  TEST_COMPARE(reports[1].iterations, >, 3);  // the old factors are weak, 0.02 of a set-up is lost
  TEST_COMPARE(reports[2].iterations, <, reports[1].iterations);  // new factors
}

TEUCHOS_UNIT_TEST(linear_solver, factors_too_weak_to_converge_are_renewed_in_the_same_solve) {
  const SmallTube tube;
  test::WallJacobian jacobian(tube);
  const auto b = test::scattered(tube.wall, 1);
  const auto solver = linear::make_linear_solver(
      resolved({{"method", "flexible gmres"}, {"preconditioner", "direct"}},
               {{"max iterations", 6}}),
      jacobian.K);
  algebra::BlockVector x = fields::zero_vector(tube.wall);
  solver->matrix_changed();
  solver->solve(b, x, 1e-8);
  jacobian.set(0.01);
  solver->matrix_changed();
  const auto report = solver->solve(b, x, 1e-8);
  TEST_ASSERT(report.is_converged);
  TEST_ASSERT(report.setup_seconds > 0.0);
  TEST_COMPARE(report.iterations, >, 6);  // the failed attempt is not hidden
  TEST_COMPARE(true_error(jacobian.K, b, x), <, 2.1e-8);
}

const std::vector<std::string> krylov_methods{"gcr", "flexible gmres", "gmres", "bicgstab",
                                              "tfqmr"};

/// Takes the equation with this number of the vector unknowns out of the system.
void clear_row(const fields::BlockOperator& K, GlobalOrdinal number) {
  CrsMatrix& M = *K.merged();
  M.resumeFill();
  const LocalOrdinal row =
      M.getRowMap()->getLocalElement(algebra::DofLayout(*K.space()).merged(0, number));
  if (row >= 0) {
    const auto local = M.getLocalMatrixHost();
    auto entries = local.row(row);
    for (int k = 0; k < entries.length; ++k) entries.value(k) = 0.0;
  }
  M.fillComplete(M.getDomainMap(), M.getRangeMap());
  K.values_changed();
}

TEUCHOS_UNIT_TEST(linear_solver, a_huge_refresh_factor_keeps_the_first_set_up) {
  const SmallTube tube;
  test::WallJacobian jacobian(tube);
  const auto b = test::scattered(tube.wall, 1);
  auto list = resolved({{"method", "gcr"}});
  list.set("refresh factor", 1e12);
  const auto solver = linear::make_linear_solver(list, jacobian.K);
  algebra::BlockVector x = fields::zero_vector(tube.wall);
  solver->matrix_changed();
  TEST_ASSERT(solver->solve(b, x, 1e-8).setup_seconds > 0.0);
  jacobian.set(0.005);
  solver->matrix_changed();
  const auto report = solver->solve(b, x, 1e-8);
  TEST_ASSERT(report.is_converged);
  TEST_EQUALITY(report.setup_seconds, 0.0);
}

TEUCHOS_UNIT_TEST(linear_solver, a_set_up_that_failed_is_not_kept) {
  const SmallTube tube;
  test::WallJacobian jacobian(tube);
  const auto b = test::scattered(tube.wall, 1);
  auto list = resolved({{"method", "gcr"}}, {{"max iterations", 2}});
  const auto solver = linear::make_linear_solver(list, jacobian.K);
  algebra::BlockVector x = fields::zero_vector(tube.wall);
  for (int k = 0; k < 2; ++k) {
    solver->matrix_changed();
    const auto report = solver->solve(b, x, 1e-12);
    TEST_ASSERT(!report.is_converged);
    TEST_EQUALITY(report.iterations, 2);
    TEST_ASSERT(report.setup_seconds > 0.0);
  }
}

TEUCHOS_UNIT_TEST(linear_solver, an_equation_without_unknowns_is_reported_with_what_remains) {
  const SmallTube tube;
  const test::WallJacobian jacobian(tube);
  const auto b = test::scattered(tube.wall, 1);
  clear_row(jacobian.K, 4);
  auto only_that_row = test::scattered(tube.wall, 1);
  for (const GlobalOrdinal row : global_numbers(*b[0].getMap()))
    if (row != 4) only_that_row[0].replaceGlobalValue(row, 0.0);
  const double least = only_that_row[0].norm2() / test::norm(b);  // no x gives less
  for (const std::string preconditioner : {"none", "ilu"})
    for (const std::string& method : krylov_methods) {
      const auto solver = linear::make_linear_solver(
          resolved({{"method", method}, {"preconditioner", preconditioner}},
                   {{"max iterations", 60}}),
          jacobian.K);
      solver->matrix_changed();
      algebra::BlockVector x = fields::zero_vector(tube.wall);
      const auto report = solver->solve(b, x, 1e-8);
      out << report.method << ", " << preconditioner << ": " << report.iterations << " iterations, "
          << report.true_residual << "\n";
      TEST_ASSERT(!report.is_converged);
      TEST_COMPARE(report.iterations, <=, 60);
      TEST_COMPARE(report.true_residual, >=, 0.999 * least);
      TEST_FLOATING_EQUALITY(report.true_residual, true_error(jacobian.K, b, x), 1e-10);
    }
}

TEUCHOS_UNIT_TEST(linear_solver, factors_of_a_singular_matrix_fail_on_all_ranks) {
  const SmallTube tube;
  const test::WallJacobian jacobian(tube);
  clear_row(jacobian.K, 4);
  algebra::BlockVector x = fields::zero_vector(tube.wall);
  for (const auto& list : {resolved({{"method", "direct"}}),
                           resolved({{"method", "gcr"}, {"preconditioner", "direct"}})}) {
    const auto solver = linear::make_linear_solver(list, jacobian.K);
    solver->matrix_changed();
    TEST_THROW(solver->solve(test::scattered(tube.wall, 1), x, 1e-8), linear::SetupFailure);
  }
}

TEUCHOS_UNIT_TEST(linear_solver, a_block_preconditioner_fails_as_factors_do) {
  const SmallTube tube;
  const test::WallJacobian jacobian(tube);
  clear_row(jacobian.K, 4);
  const test::Diagonals operators(jacobian.K, {{"Schur Mass", 1e-6}});
  algebra::BlockVector x = fields::zero_vector(tube.wall);
  for (const auto& list :
       {test::strategy("LU Upper", "Algebraic"), linear::default_block_preconditioner(1, 1)}) {
    const auto solver =
        linear::make_linear_solver(test::solver_list("gcr", list), jacobian.K, operators);
    solver->matrix_changed();
    TEST_THROW(solver->solve(test::scattered(tube.wall, 1), x, 1e-8), linear::SetupFailure);
  }
}

TEUCHOS_UNIT_TEST(linear_solver, a_right_side_that_is_no_number_has_no_solution) {
  const SmallTube tube;
  const test::WallJacobian jacobian(tube);
  auto b = test::scattered(tube.wall, 1);
  b[1].putScalar(std::nan(""));
  std::vector<Teuchos::ParameterList> lists{resolved({{"method", "direct"}})};
  for (const std::string& method : krylov_methods)
    for (const std::string preconditioner : {"none", "ilu", "direct"})
      lists.push_back(resolved({{"method", method}, {"preconditioner", preconditioner}}));
  for (const auto& list : lists) {
    const auto solver = linear::make_linear_solver(list, jacobian.K);
    solver->matrix_changed();
    algebra::BlockVector x = fields::zero_vector(tube.wall);
    TEST_ASSERT(!solver->solve(b, x, 1e-8).is_converged);
  }
}

TEUCHOS_UNIT_TEST(linear_solver, a_singular_preconditioner_ends_with_an_honest_report) {
  const SmallTube tube;
  test::WallJacobian jacobian(tube);
  jacobian.set(0.005);
  const auto b = test::scattered(tube.wall, 1);
  // S̃⁻¹ = 0: the pressure stays where it is.
  const test::Diagonals operators(jacobian.K, {{"Schur Mass", 1e300}, {"Schur Bulk Mass", 1e300}});
  for (const std::string& method : krylov_methods) {
    auto list = test::solver_list(method, test::strategy("LU Upper", "Scaled Mass"));
    list.set("max iterations", 60);
    const auto solver = linear::make_linear_solver(list, jacobian.K, operators);
    solver->matrix_changed();
    algebra::BlockVector x = fields::zero_vector(tube.wall);
    const auto report = solver->solve(b, x, 1e-8);
    out << report.method << ": " << report.iterations << " iterations, "
        << report.recurrence_residual << ", in truth " << report.true_residual << "\n";
    TEST_ASSERT(!report.is_converged);
    TEST_COMPARE(report.iterations, <=, 60);
    TEST_COMPARE(report.true_residual, >, 2e-8);
    TEST_FLOATING_EQUALITY(report.true_residual, true_error(jacobian.K, b, x), 1e-8);
  }
}

TEUCHOS_UNIT_TEST(linear_solver, a_preconditioner_that_gives_no_numbers_leaves_the_start) {
  const SmallTube tube;
  const test::WallJacobian jacobian(tube);
  const auto b = test::scattered(tube.wall, 1);
  const test::Diagonals operators(jacobian.K, {{"Schur Mass", 0.0}, {"Schur Bulk Mass", 0.0}});
  for (const std::string& method : krylov_methods) {
    const auto solver = linear::make_linear_solver(
        test::solver_list(method, test::strategy("LU Upper", "Scaled Mass")), jacobian.K,
        operators);
    solver->matrix_changed();
    algebra::BlockVector x = fields::zero_vector(tube.wall);
    const auto report = solver->solve(b, x, 1e-8);
    TEST_ASSERT(!report.is_converged);
    TEST_EQUALITY(report.true_residual, 1.0);
    TEST_EQUALITY(test::norm(x), 0.0);
  }
}

/// Solves to 1e-10, checked against the matrix. Iterations.
int solve_well(linear::LinearSolver& solver, const fields::BlockOperator& K,
               const algebra::BlockVector& b, Teuchos::FancyOStream& out, bool& success) {
  algebra::BlockVector x = K.zero();
  const auto report = solver.solve(b, x, 1e-10);
  TEST_ASSERT(report.is_converged);
  TEST_COMPARE(true_error(K, b, x), <, 2.1e-10);
  return report.iterations;
}

TEUCHOS_UNIT_TEST(linear_solver, recycled_directions_serve_every_right_side_of_their_matrix) {
  const SmallTube tube;
  test::WallJacobian jacobian(tube);
  const auto recycling =
      linear::make_linear_solver(resolved({{"method", "gcr"}}, {{"recycle", 100}}), jacobian.K);
  const auto plain = linear::make_linear_solver(resolved({{"method", "gcr"}}), jacobian.K);
  const auto first = test::scattered(tube.wall, 1);
  auto second = test::scattered(tube.wall, 2);
  for (int b = 0; b < second.n_blocks(); ++b) second[b].update(1.0, first[b], 0.01);
  for (const auto& solver : {recycling.get(), plain.get()}) solver->matrix_changed();
  const auto iterations = [&](linear::LinearSolver& solver, const algebra::BlockVector& b) {
    return solve_well(solver, jacobian.K, b, out, success);
  };
  const int fresh = iterations(*plain, first), same = iterations(*recycling, first);
  TEST_EQUALITY(same, fresh);
  TEST_COMPARE(fresh, <=, 100);  // all are kept, or what follows would not hold
  const int again = iterations(*recycling, first);
  TEST_EQUALITY(again, 0);
  // nearly the first: what remains is a hundredth
  const int kept = iterations(*recycling, second), none = iterations(*plain, second);
  TEST_COMPARE(kept, >, 0);
  TEST_COMPARE(kept, <, none);
}

TEUCHOS_UNIT_TEST(linear_solver, directions_of_another_matrix_are_not_recycled) {
  const SmallTube tube;
  test::WallJacobian jacobian(tube);
  const auto recycling =
      linear::make_linear_solver(resolved({{"method", "gcr"}}, {{"recycle", 100}}), jacobian.K);
  const auto b = test::scattered(tube.wall, 1);
  recycling->matrix_changed();
  solve_well(*recycling, jacobian.K, b, out, success);
  jacobian.set(0.005);
  recycling->matrix_changed();
  recycling->prepare();
  const auto plain = linear::make_linear_solver(resolved({{"method", "gcr"}}), jacobian.K);
  plain->matrix_changed();
  const int anew = solve_well(*recycling, jacobian.K, b, out, success);
  const int fresh = solve_well(*plain, jacobian.K, b, out, success);
  TEST_EQUALITY(anew, fresh);
}

TEUCHOS_UNIT_TEST(linear_solver, a_right_side_that_is_no_number_leaves_nothing_to_recycle) {
  const SmallTube tube;
  const test::WallJacobian jacobian(tube);
  const auto solver =
      linear::make_linear_solver(resolved({{"method", "gcr"}}, {{"recycle", 100}}), jacobian.K);
  solver->matrix_changed();
  auto b = test::scattered(tube.wall, 1);
  auto x = jacobian.K.zero();
  b[0].scale(std::nan(""));
  TEST_ASSERT(!solver->solve(b, x, 1e-8).is_converged);
  solve_well(*solver, jacobian.K, test::scattered(tube.wall, 1), out, success);
}

}  // namespace
