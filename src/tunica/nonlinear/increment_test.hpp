#pragma once
#include <NOX_StatusTest_Generic.H>

#include "tunica/nonlinear/nox_group.hpp"

namespace tunica::nonlinear {

/// Stops Newton's method on the mass norm of the increment ([LY1] newstop), on divergence
/// and at the cap, and fills the report. Instead of the increment made it may look at what the next
/// one is expected to be, or at all that would follow (ours):
///
///   |dx_{k+1}| ≈ min(1, s |F_k|/|F_{k−1}|) |dx_k|
///   Σ_{l>k} |dx_l| ≲ ρ/(1 − ρ) |dx_k|,   ρ = |dx_k|/|dx_{k−1}|
///
///   F_k  residual after step k, Euclidean norm over both unknowns, mixed units
///   s    safety  1: errors in a nearly incompressible wall fall up to 30 times less than residuals
class IncrementTest : public NOX::StatusTest::Generic {
public:
  IncrementTest(NonlinearProblem& problem, const NewtonOptions& options, const SolveLog& log,
                JacobianRule& rule, NewtonReport& report)
      : problem_(&problem), options_(options), log_(&log), rule_(&rule), report_(&report),
        had_led_away_(rule.has_led_away()) {}

  NOX::StatusTest::StatusType checkStatus(const NOX::Solver::Generic& solver,
                                          NOX::StatusTest::CheckType type) override;
  NOX::StatusTest::StatusType getStatus() const override { return status_; }
  std::ostream& print(std::ostream& stream, int indent = 0) const override;

private:
  void record(const NOX::Solver::Generic& solver);
  NOX::StatusTest::StatusType judge(const NOX::Solver::Generic& solver);
  bool is_too_slow() const;

  NonlinearProblem* problem_;
  NewtonOptions options_;
  const SolveLog* log_;
  JacobianRule* rule_;
  NewtonReport* report_;
  bool had_led_away_;  ///< an old Jacobian, before this solve
  NOX::StatusTest::StatusType status_ = NOX::StatusTest::Unevaluated;
};

}  // namespace tunica::nonlinear
