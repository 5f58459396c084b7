#pragma once
#include <functional>
#include <string>
#include <vector>

#include "tunica/algebra/block_vector.hpp"
#include "tunica/base/outcome.hpp"
#include "tunica/linear/linear_solver.hpp"
#include "tunica/nonlinear/forcing.hpp"
#include "tunica/nonlinear/jacobian_rule.hpp"
#include "tunica/params/table.hpp"

namespace tunica::nonlinear {

/// F(x) = 0 over any blocks, as Newton's method sees it. All members are collective. A caller may
/// ask for residuals and Jacobians at any points in any order, for a Jacobian only where there is a
/// residual; products and solves are those of the last Jacobian.
class NonlinearProblem {
public:
  virtual ~NonlinearProblem() = default;

  virtual const algebra::BlockSpacePtr& space() const = 0;
  /// F at x, or why x is not admissible (an inverted element). The same on all ranks.
  virtual Outcome residual(const algebra::BlockVector& x, algebra::BlockVector& F) = 0;
  /// Brings the Jacobian of linear_solver() to x, wherever residuals were asked for before.
  virtual void jacobian(const algebra::BlockVector& x) = 0;
  virtual void apply_jacobian(const algebra::BlockVector& x, algebra::BlockVector& y) const = 0;
  virtual linear::LinearSolver& linear_solver() = 0;
  /// Gives unknowns that are prescribed the increment they have, which an inexact solve misses. The
  /// residual, which takes their values for granted, would not show it.
  virtual void hold_prescribed(algebra::BlockVector& dx) const { static_cast<void>(dx); }
  /// The norm by which Newton's method stops; of a field (dxᵀ M dx)^½ with the mass matrices of all
  /// unknowns, [LY1] newstop.
  virtual double increment_norm(const algebra::BlockVector& dx) = 0;
};

struct NewtonStep;
/// Called with each step of Newton's method once it is made, on all ranks.
using NewtonWatch = std::function<void(const NewtonStep&)>;

enum class StopAt { increment, next_increment, remaining_error };

struct NewtonOptions {
  int max_iterations = 0;
  double relative_increment = 0.0;     ///< ε2: stop at |dx_k| ≤ ε2 |dx_1|
  double absolute_increment = 0.0;     ///< or at |dx_k| ≤ this
  StopAt stop_at = StopAt::increment;  ///< what those two are compared with
  double safety = 0.0;                 ///< s of IncrementTest
  double growth_limit = 0.0;           ///< give up at |dx_k| > limit |dx_1|
  double jacobian_cost = 0.0;          ///< c of JacobianRule
  std::string line_search;             ///< "guarded", "full step", "backtrack", "polynomial"
  ForcingOptions forcing{};
  /// Where Jacobians that were kept have failed, from the start with a new one in each step.
  bool tries_again = true;
  /// Give up as soon as max_iterations would not do at the pace of the last steps.
  bool looks_ahead = false;
  NewtonWatch watch{};  ///< may be empty
};
/// Defaults of the keys of the stopping criterion.
struct NewtonDefaults {
  double relative_increment = 1e-8;
  double absolute_increment = 1e-9;
  std::string unit = "mixed";  ///< of increments
  std::string stop_at = "increment";
  double linear_tolerance = 1e-8;
  double jacobian_cost = 0.0;
};
params::Table newton_table(const NewtonDefaults& defaults = {});
NewtonOptions newton_options(const Teuchos::ParameterList& list);

struct NewtonStep {
  double increment = 0.0;           ///< mass norm of the full Newton step
  double relative_increment = 0.0;  ///< to the first one
  double residual = 0.0;            ///< Euclidean norm of F after the step
  double exponent = 0.0;            ///< log(e_k/e_{k−1})/log(e_{k−1}/e_{k−2}); else 0
  double step_length = 0.0;         ///< of the line search
  linear::SolveReport linear;
};

struct NewtonReport {
  bool is_converged = false;
  std::string reason;              ///< why not
  std::vector<NewtonStep> steps;   ///< all, also those of attempts that were given up
  int earlier_steps = 0;           ///< of them, before the last attempt
  bool is_linear_failure = false;  ///< the linear solver gave up, or could not be set up
  bool is_too_slow = false;        ///< max_iterations were, or would have been, too few

  /// Puts the steps of an earlier attempt before.
  void comes_after(const NewtonReport& earlier);
  int linear_iterations() const;
};

/// Newton's method through NOX, started from and returning in x. rule: says where the last Jacobian
/// may serve again; null: a new one in each step.
NewtonReport solve_newton(NonlinearProblem& problem, const NewtonOptions& options,
                          algebra::BlockVector& x, JacobianRule* rule = nullptr);

}  // namespace tunica::nonlinear
