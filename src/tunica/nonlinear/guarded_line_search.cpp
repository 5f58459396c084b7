#include "tunica/nonlinear/guarded_line_search.hpp"

#include <NOX_Abstract_Group.H>
#include <NOX_Solver_Generic.H>

#include <algorithm>

namespace tunica::nonlinear {

bool GuardedLineSearch::compute(NOX::Abstract::Group& group, double& step,
                                const NOX::Abstract::Vector& direction,
                                const NOX::Solver::Generic& solver) {
  constexpr double smallest = 1.0 / 4096.0, most_growth = 1e3;
  const NOX::Abstract::Group& old_group = solver.getPreviousSolutionGroup();
  const double old_norm = old_group.getNormF();
  if (first_norm_ < 0.0) first_norm_ = old_norm;
  const double bound = most_growth * std::max(first_norm_, old_norm);
  double computable = 0.0;
  for (step = 1.0; step >= smallest; step *= 0.5) {
    group.computeX(old_group, direction, step);
    if (group.computeF() != NOX::Abstract::Group::Ok) continue;
    const double norm = group.getNormF();
    if (wants_decrease_ ? norm < old_norm : norm <= bound) return true;
    if (wants_decrease_ || computable == 0.0) computable = step;
  }
  step = computable;
  if (step > 0.0) {
    group.computeX(old_group, direction, step);
    return group.computeF() == NOX::Abstract::Group::Ok;
  }
  group = old_group;
  return false;
}

}  // namespace tunica::nonlinear
