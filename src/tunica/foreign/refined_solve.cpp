#include "tunica/foreign/refined_solve.hpp"

#include <algorithm>
#include <cmath>

namespace tunica::foreign {

namespace {

constexpr int most_refinements = 3;

/// How many times what is permitted is left.
double excess(const Residuals& residuals, double tolerance) {
  return std::max(residuals.largest_of_fields(), residuals.relative) / tolerance;
}

/// The whole may drift by round-off; a field that is beyond the tolerance has been left behind.
bool are_done(const Residuals& residuals, double tolerance) {
  return residuals.are_within(tolerance) && residuals.largest_of_fields() <= tolerance + 1e-14;
}

/// Whether the method has got as far as it was asked to: a cap or a stagnation is its own result.
bool believes_to_be_done(const linear::SolveReport& report) {
  return report.method == "direct" || report.recurrence_residual <= report.tolerance;
}

}  // namespace

linear::SolveReport refined_solve(linear::LinearSolver& solver, const algebra::BlockVector& b,
                                  const Judge& judge, double tolerance, algebra::BlockVector& x,
                                  Residuals& residuals) {
  linear::SolveReport report = solver.solve(b, x, tolerance);
  algebra::BlockVector r(b.space()), dx(b.space()), before(b.space());
  residuals = judge(x, r);
  for (int pass = 0; pass < most_refinements; ++pass) {
    const double left = excess(residuals, tolerance);
    if (are_done(residuals, tolerance) || !std::isfinite(left) || !believes_to_be_done(report))
      break;
    // K dx = b − K x to half of what the worst field permits
    const double goal = std::clamp(0.5 / left, 1e-10, 0.5);
    linear::add_costs(solver.solve(r, dx, goal), report);
    before.assign(x);
    for (int i = 0; i < x.n_blocks(); ++i) x[i].update(1.0, dx[i], 1.0);
    const Residuals next = judge(x, r);
    const bool is_nearer = are_done(next, tolerance) || excess(next, tolerance) < 0.5 * left;
    if (is_nearer)
      residuals = next;
    else
      x.assign(before);
    if (!is_nearer) break;
  }
  report.true_residual = residuals.relative;
  report.is_converged = residuals.are_within(tolerance);
  return report;
}

}  // namespace tunica::foreign
