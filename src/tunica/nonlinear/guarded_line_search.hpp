#pragma once
#include <NOX_LineSearch_Generic.H>
#include <NOX_LineSearch_UserDefinedFactory.H>

namespace tunica::nonlinear {

/// Full Newton steps, halved only while the new point is not admissible: F cannot be computed
/// there (an inverted element) or is not finite. Keeps the quadratic convergence that a
/// decrease condition on a badly scaled residual would spoil.
class GuardedLineSearch : public NOX::LineSearch::Generic {
public:
  bool compute(NOX::Abstract::Group& group, double& step, const NOX::Abstract::Vector& direction,
               const NOX::Solver::Generic& solver) override;
};

class GuardedLineSearchFactory : public NOX::LineSearch::UserDefinedFactory {
public:
  Teuchos::RCP<NOX::LineSearch::Generic> buildLineSearch(const Teuchos::RCP<NOX::GlobalData>&,
                                                         Teuchos::ParameterList&) const override {
    return Teuchos::rcp(new GuardedLineSearch);
  }
};

}  // namespace tunica::nonlinear
