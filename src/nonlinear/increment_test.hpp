#pragma once
#include <NOX_StatusTest_Generic.H>

#include "nonlinear/nox_group.hpp"

namespace tunica::nonlinear {

/// Stops Newton's method on the mass norm of the increment ([LY1] eq:newstop), on divergence
/// and at the cap, and fills the report.
class IncrementTest : public NOX::StatusTest::Generic {
public:
  IncrementTest(NonlinearProblem& problem, const NewtonOptions& options, const SolveLog& log,
                NewtonReport& report)
      : problem_(&problem), options_(options), log_(&log), report_(&report) {}

  NOX::StatusTest::StatusType checkStatus(const NOX::Solver::Generic& solver,
                                          NOX::StatusTest::CheckType type) override;
  NOX::StatusTest::StatusType getStatus() const override { return status_; }
  std::ostream& print(std::ostream& stream, int indent = 0) const override;

private:
  void record(const NOX::Solver::Generic& solver);
  NOX::StatusTest::StatusType judge(const NOX::Solver::Generic& solver);

  NonlinearProblem* problem_;
  NewtonOptions options_;
  const SolveLog* log_;
  NewtonReport* report_;
  NOX::StatusTest::StatusType status_ = NOX::StatusTest::Unevaluated;
};

}  // namespace tunica::nonlinear
