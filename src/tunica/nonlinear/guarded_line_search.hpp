#pragma once
#include <NOX_LineSearch_Generic.H>
#include <NOX_LineSearch_UserDefinedFactory.H>

namespace tunica::nonlinear {

/// Full Newton steps, halved only while the new point is not admissible: F cannot be computed
/// there (an inverted element), is not finite, or is a thousand times as large as at the start of
/// the solve and before the step, as where an element is all but flat: from there no step leads
/// back, and the system is one that no linear solver likes. Keeps the quadratic convergence that a
/// decrease condition on a badly scaled residual would spoil. That condition, |F| < |F_old|, may be
/// asked for all the same. Where no length meets what is asked of |F|, guarded takes the longest
/// that can be computed, decrease the shortest.
class GuardedLineSearch : public NOX::LineSearch::Generic {
public:
  explicit GuardedLineSearch(bool wants_decrease) : wants_decrease_(wants_decrease) {}

  bool compute(NOX::Abstract::Group& group, double& step, const NOX::Abstract::Vector& direction,
               const NOX::Solver::Generic& solver) override;

private:
  bool wants_decrease_;
  double first_norm_ = -1.0;  ///< |F| at the start of the solve
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
