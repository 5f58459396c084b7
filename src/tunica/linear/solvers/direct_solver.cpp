#include "tunica/linear/solvers/direct_solver.hpp"

#include <algorithm>

#include "tunica/base/timer.hpp"
#include "tunica/linear/krylov.hpp"
#include "tunica/linear/setup_failure.hpp"
#include "tunica/linear/solvers/relative_residual.hpp"

namespace tunica::linear {

DirectSolver::DirectSolver(const algebra::BlockMatrix& K, double most_operations)
    : K_(K), factor_(K_.matrix(), most_operations),
      augmented_(
          K, K_.matrix(),
          [this](const algebra::BlockVector& x, MultiVector& all) { K_.merge(x, all); },
          [this](const MultiVector& all, algebra::BlockVector& x) { K_.split(all, x); }),
      b_(K_.matrix()->getRowMap()), x_(b_.getMap()) {}

void DirectSolver::prepare() {
  K_.refresh();
  factor_.refresh();
  augmented_.refresh_matrix();
  // K Z = W by the factors: Z is exact, and with it the inverse of the sum.
  if (!augmented_.refresh_inverse(Teuchos::rcpFromRef(factor_),
                                  [this](const Vector& w, Vector& z) { factor_.apply(w, z); }))
    throw SetupFailure("the matrix is singular with the terms that couple whole surfaces");
  is_stale_ = false;
}

SolveReport DirectSolver::solve(const algebra::BlockVector& b, algebra::BlockVector& x,
                                double tolerance) {
  SolveReport report;
  report.method = report.preconditioner = "direct";
  report.tolerance = tolerance;
  const Stopwatch set_up;
  if (is_stale_) prepare();
  report.setup_seconds = set_up.seconds();
  const Stopwatch solving;
  K_.merge(b, b_);
  report.iterations = 1;
  if (augmented_.has_action())
    report.iterations = solve_whole(tolerance);
  else if (augmented_.has_low_rank())
    solve_sum();
  else
    factor_.apply(b_, x_);
  K_.split(x_, x);
  report.solve_seconds = solving.seconds();
  report.true_residual = relative_residual(*augmented_.matrix(), b_, x_);
  report.recurrence_residual = report.true_residual;
  // Factors leave what round-off does, whatever is asked for.
  const double enough = std::max(tolerance, 1e-8);
  report.is_converged = report.true_residual <= (augmented_.has_action() ? 2.0 * enough : enough);
  return report;
}

// (A + W S Vᵀ + L) x = b by GCR, with the inverse of all but L for preconditioner
int DirectSolver::solve_whole(double tolerance) {
  const int most = 100;
  x_.putScalar(0.0);
  return solve_krylov({"GCR", most, most}, augmented_.matrix(),
                      augmented_.inverse(Teuchos::rcpFromRef(factor_)), b_, x_, tolerance)
      .iterations;
}

// The formula loses the digits by which the part of low rank outweighs the blocks; a step of
// iterative refinement brings them back.
void DirectSolver::solve_sum() {
  const Teuchos::RCP<const Operator> inverse = augmented_.inverse(Teuchos::rcpFromRef(factor_));
  Vector r(b_.getMap()), dx(b_.getMap());
  inverse->apply(b_, x_);
  augmented_.matrix_with_low_rank()->apply(x_, r);
  r.update(1.0, b_, -1.0);  // r = b − K x
  inverse->apply(r, dx);
  x_.update(1.0, dx, 1.0);
}

}  // namespace tunica::linear
