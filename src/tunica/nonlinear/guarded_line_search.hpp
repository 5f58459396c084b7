#pragma once
#include <NOX_LineSearch_Generic.H>
#include <NOX_LineSearch_UserDefinedFactory.H>

namespace tunica::nonlinear {

/// Full Newton steps, halved only while the new point is not admissible: F cannot be computed
/// there (an inverted element) or is not finite. Keeps the quadratic convergence that a
/// decrease condition on a badly scaled residual would spoil. That condition, |F| < |F_old|, may be
/// asked for all the same; where no length meets it, the shortest that is admissible is taken.
class GuardedLineSearch : public NOX::LineSearch::Generic {
public:
  explicit GuardedLineSearch(bool wants_decrease) : wants_decrease_(wants_decrease) {}

  bool compute(NOX::Abstract::Group& group, double& step, const NOX::Abstract::Vector& direction,
               const NOX::Solver::Generic& solver) override;

private:
  bool wants_decrease_;
};

class GuardedLineSearchFactory : public NOX::LineSearch::UserDefinedFactory {
public:
  explicit GuardedLineSearchFactory(bool wants_decrease) : wants_decrease_(wants_decrease) {}

  Teuchos::RCP<NOX::LineSearch::Generic> buildLineSearch(const Teuchos::RCP<NOX::GlobalData>&,
                                                         Teuchos::ParameterList&) const override {
    return Teuchos::rcp(new GuardedLineSearch(wants_decrease_));
  }

private:
  bool wants_decrease_;
};

}  // namespace tunica::nonlinear
