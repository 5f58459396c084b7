#pragma once
#include "tunica/foreign/residuals.hpp"
#include "tunica/linear/linear_solver.hpp"

namespace tunica::foreign {

/// Solves from zero and, while the method takes for solved what is not, for what is left:
///
///   K x₁ = b,   K dx = b − K x_k  to  τ s_k,   x_{k+1} = x_k + dx
///
///   τ    tolerance
///   s_k  by how much the worst field, or the whole, misses it: 1 over that
///
/// Factors lose digits where pivots are small, the recurrence of a Krylov method drifts, and its
/// norm does not see a field of small rows; all three show in b − K x of the fields. Steps that
/// neither reach the tolerance nor halve what is left are taken back. The report is that of all
/// solves. Collective.
linear::SolveReport refined_solve(linear::LinearSolver& solver, const algebra::BlockVector& b,
                                  const Judge& judge, double tolerance, algebra::BlockVector& x,
                                  Residuals& residuals);

}  // namespace tunica::foreign
