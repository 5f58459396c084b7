#include <Teuchos_UnitTestHarness.hpp>
#include <Tpetra_Core.hpp>

#include "tunica/base/trilinos.hpp"
#include "tunica/foreign/refined_solve.hpp"

namespace {

using namespace tunica;

/// diag(a, …, a) and diag(c, …, c) as blocks of a system, coupled by B1T = B2ᵀ = β I.
struct System {
  System(double a, double c, double beta) {
    const CommPtr comm = Tpetra::getDefaultComm();
    const auto map = Teuchos::rcp(new Map(4, 0, comm));
    K = algebra::BlockMatrix(std::make_shared<const algebra::BlockSpace>(
        std::vector<algebra::Block>{{"vector", map, 1, {}}, {"scalar", map, 1, {}}}));
    const double values[2][2] = {{a, beta}, {beta, c}};
    for (const int i : {0, 1})
      for (const int j : {0, 1}) {
        const auto block = Teuchos::rcp(new CrsMatrix(map, 1));
        for (const GlobalOrdinal row : global_numbers(*map))
          block->insertGlobalValues(row, 1, &values[i][j], &row);
        block->fillComplete();
        K.set(i, j, block);
      }
    b = K.zero();
    x = K.zero();
  }
  algebra::BlockMatrix K;
  algebra::BlockVector b, x;
};

TEUCHOS_UNIT_TEST(residuals, a_field_of_small_rows_is_judged_by_itself) {
  System system(1e6, 1e-6, 0.0);
  system.b[0].putScalar(1e6);
  system.b[1].putScalar(1e-6);
  system.x[0].putScalar(1.0);
  system.x[1].putScalar(2.0);  // the solution is 1
  const auto found = foreign::residuals_of(system.K, system.b, system.x);
  TEST_COMPARE(found.relative, <, 2e-12);
  TEST_COMPARE(found.backward_error, <, 2e-12);
  TEST_COMPARE(found.of_fields[0], <, 1e-15);
  TEST_FLOATING_EQUALITY(found.of_fields[1], 1.0 / 3.0, 1e-12);  // |1 − 2| / (2 + 1)
  TEST_ASSERT(!found.are_within(1e-8));
}

TEUCHOS_UNIT_TEST(residuals, what_rounding_leaves_is_solved) {
  // x = (10¹², −10¹²) cancels in b = 1: |b − K x| / |b| is of the size ε |K| |x| / |b| = 10⁻⁴
  System system(1.0, 1.0, 1.0);
  system.b[0].putScalar(1.0);
  system.b[1].putScalar(1.0);
  system.x[0].putScalar(1e12 + 1.0 + 1e-4);
  system.x[1].putScalar(-1e12);
  const auto found = foreign::residuals_of(system.K, system.b, system.x);
  TEST_COMPARE(found.relative, >, 1e-5);
  TEST_COMPARE(found.backward_error, <, 1e-15);
  TEST_ASSERT(found.are_within(1e-8) && found.are_rounding(1e-8));
  TEST_ASSERT(!found.are_rounding(1e-3));
}

TEUCHOS_UNIT_TEST(residuals, a_field_does_not_hide_its_error_in_the_rounding_of_another) {
  foreign::Residuals found{{1e-10, 1e-16}, 1e-15, 1e-7};
  TEST_ASSERT(!found.are_within(1e-8));
  found.of_fields.front() = 1e-15;
  TEST_ASSERT(found.are_within(1e-8));
}

/// Takes (1 − error) of a solution for the solution.
class Careless final : public linear::LinearSolver {
public:
  Careless(const System& system, double error) : system_(&system), error_(error) {}
  void matrix_changed() override {}
  void prepare() override {}
  void forget() override {}
  linear::SolveReport solve(const algebra::BlockVector& b, algebra::BlockVector& x,
                            double tolerance) override {
    for (const int i : {0, 1}) {
      const double d = system_->K(i, i)->getLocalMatrixHost().values(0);
      x[i].update((1.0 - error_) / d, b[i], 0.0);
    }
    linear::SolveReport report;
    report.tolerance = tolerance;
    report.recurrence_residual = 0.1 * tolerance;
    report.iterations = 7;
    return report;
  }

private:
  const System* system_;
  double error_;
};

TEUCHOS_UNIT_TEST(refined_solve, solves_for_what_a_method_has_left) {
  System system(2.0, -3.0, 0.0);
  system.b[0].putScalar(1.0);
  system.b[1].putScalar(1.0);
  Careless solver(system, 1e-3);
  foreign::Residuals residuals;
  const auto report = foreign::refined_solve(
      solver, system.b, foreign::judge_of(system.K, system.b), 1e-8, system.x, residuals);
  // 10⁻³, 10⁻⁶, 10⁻⁹
  TEST_ASSERT(report.is_converged && residuals.are_within(1e-8));
  TEST_EQUALITY(report.iterations, 21);
  TEST_FLOATING_EQUALITY(report.true_residual, 1e-9, 1e-3);
}

TEUCHOS_UNIT_TEST(refined_solve, steps_that_do_not_help_are_taken_back) {
  System system(2.0, -3.0, 0.0);
  system.b[0].putScalar(1.0);
  system.b[1].putScalar(1.0);
  Careless solver(system, 0.7);
  foreign::Residuals residuals;
  const auto report = foreign::refined_solve(
      solver, system.b, foreign::judge_of(system.K, system.b), 1e-8, system.x, residuals);
  TEST_ASSERT(!report.is_converged);
  TEST_FLOATING_EQUALITY(residuals.relative, 0.7, 1e-12);
  TEST_FLOATING_EQUALITY(foreign::residuals_of(system.K, system.b, system.x).relative, 0.7, 1e-12);
}

}  // namespace
