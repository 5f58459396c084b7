#pragma once
#include <memory>

#include "tunica/base/types.hpp"
#include "tunica/params/table.hpp"

namespace tunica::linear {

/// What a solve is to reach, of each column.
struct ScalarGoal {
  double tolerance;  ///< |b − K x|/|b|
  /// Enough, where that is more: this part of the residual of the start, of all columns together,
  /// of which no more than a hundredth of |B| counts.
  double reduction = 0.0;
  bool starts_from_zero = false;  ///< X holds zeros: they need not be multiplied by K
};

/// Relative residuals: the one that is left and the one that was wanted.
struct ScalarAnswer {
  double residual, wanted;
  /// Iterative solvers stop by an estimate of the residual, of which twice is permitted.
  bool is_good() const { return residual <= 2.0 * wanted; }
};

/// Solves with one symmetric positive definite matrix that never changes, as mesh motion does, for
/// any number of columns; or for the three components of a vector, which are columns too.
class ScalarSolver {
public:
  virtual ~ScalarSolver() = default;
  /// X = K⁻¹ B for every column, started from the X given. Returns the relative residual.
  double solve(const MultiVector& B, MultiVector& X) {
    return solve_to({tolerance()}, B, X).residual;
  }
  /// Solves to another goal. Collective.
  virtual ScalarAnswer solve_to(const ScalarGoal& goal, const MultiVector& B, MultiVector& X) = 0;
  /// The relative residual that solve() aims at.
  virtual double tolerance() const = 0;
};

/// The keys of a "Linear Solver" list for symmetric positive definite scalar problems.
params::Table scalar_solver_table();

/// Throws SetupFailure (setup_failure.hpp) for a singular matrix. Collective.
std::unique_ptr<ScalarSolver> make_scalar_solver(const Teuchos::ParameterList& options,
                                                 const Teuchos::RCP<CrsMatrix>& K);

/// A solver for a matrix K of three unknowns for each row of L, 3 row + i, which is as stiff as L
/// in each of them up to a factor: a cycle for L preconditions all three. The maps have no gaps.
/// Collective.
std::unique_ptr<ScalarSolver> make_vector_solver(const Teuchos::ParameterList& options,
                                                 const Teuchos::RCP<CrsMatrix>& K,
                                                 const Teuchos::RCP<CrsMatrix>& L);

}  // namespace tunica::linear
