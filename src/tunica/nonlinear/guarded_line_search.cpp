#include "tunica/nonlinear/guarded_line_search.hpp"

#include <NOX_Abstract_Group.H>
#include <NOX_Solver_Generic.H>

namespace tunica::nonlinear {

bool GuardedLineSearch::compute(NOX::Abstract::Group& group, double& step,
                                const NOX::Abstract::Vector& direction,
                                const NOX::Solver::Generic& solver) {
  constexpr double smallest = 1.0 / 4096.0;
  const NOX::Abstract::Group& old_group = solver.getPreviousSolutionGroup();
  double admissible = 0.0;
  for (step = 1.0; step >= smallest; step *= 0.5) {
    group.computeX(old_group, direction, step);
    if (group.computeF() != NOX::Abstract::Group::Ok) continue;
    if (!wants_decrease_ || group.getNormF() < old_group.getNormF()) return true;
    admissible = step;
  }
  step = admissible;
  if (step > 0.0) {
    group.computeX(old_group, direction, step);
    return group.computeF() == NOX::Abstract::Group::Ok;
  }
  group = old_group;
  return false;
}

}  // namespace tunica::nonlinear
