#include "tunica/nonlinear/increment_test.hpp"

#include <NOX_Solver_Generic.H>

#include <algorithm>
#include <cmath>
#include <sstream>

namespace tunica::nonlinear {

namespace {

/// The part of the last increment that the next one is expected to be, at most all of it.
double next_part(const NOX::Solver::Generic& solver, double safety) {
  const auto& before = solver.getPreviousSolutionGroup();
  if (!before.isF() || before.getNormF() == 0.0) return 1.0;
  return std::min(1.0, safety * solver.getSolutionGroup().getNormF() / before.getNormF());
}

/// The part of the last increment that all that would follow are expected to add up to.
double remaining_part(const std::vector<NewtonStep>& steps) {
  if (steps.size() < 2 || !(steps[steps.size() - 2].increment > 0.0)) return 1.0;
  const double rate = steps.back().increment / steps[steps.size() - 2].increment;
  return rate < 0.5 ? rate / (1.0 - rate) : 1.0;
}

/// Steps until increments have fallen to the goal, at the faster pace of the last two: a single
/// slow one may be that of an old Jacobian, after which a new one is taken.
double steps_left(const std::vector<NewtonStep>& steps, double goal) {
  const std::size_t n = steps.size();
  if (n < 3 || !(goal > 0.0)) return 0.0;
  const auto rate = [&](std::size_t k) { return steps[k].increment / steps[k - 1].increment; };
  return steps_to(goal, steps.back().increment, std::min(rate(n - 1), rate(n - 2)));
}

}  // namespace

void IncrementTest::record(const NOX::Solver::Generic& solver) {
  const Teuchos::RCP<NOX::Abstract::Vector> dx =
      solver.getSolutionGroup().getX().clone(NOX::DeepCopy);
  dx->update(-1.0, solver.getPreviousSolutionGroup().getX(), 1.0);
  auto& steps = report_->steps;
  NewtonStep step;
  step.residual = solver.getSolutionGroup().getNormF();
  step.step_length = log_->step_length;
  // Of the whole Newton step: a short one must not pass for convergence.
  step.increment = problem_->increment_norm(blocks_of(*dx, problem_->space())) / step.step_length;
  step.linear = log_->linear.back();
  const double first = steps.empty() ? step.increment : steps.front().increment;
  step.relative_increment = first > 0.0 ? step.increment / first : 0.0;
  if (steps.size() >= 2 && step.increment > 0.0) {
    const double e1 = steps.back().increment, e2 = steps[steps.size() - 2].increment;
    step.exponent = std::log(step.increment / e1) / std::log(e1 / e2);
  }
  steps.push_back(step);
  rule_->note(steps);
  if (options_.watch) options_.watch(step);
}

bool IncrementTest::is_too_slow() const {
  const auto& steps = report_->steps;
  const int n = static_cast<int>(steps.size());
  if (n >= options_.max_iterations) return true;
  if (!options_.looks_ahead) return false;
  const double goal =
      std::max(options_.absolute_increment, options_.relative_increment * steps.front().increment);
  return n + steps_left(steps, goal) > options_.max_iterations;
}

NOX::StatusTest::StatusType IncrementTest::judge(const NOX::Solver::Generic& solver) {
  const NewtonStep& step = report_->steps.back();
  double part = 1.0;
  if (step.step_length == 1.0 && options_.stop_at == StopAt::next_increment)
    part = next_part(solver, options_.safety);
  if (step.step_length == 1.0 && options_.stop_at == StopAt::remaining_error)
    part = remaining_part(report_->steps);
  std::ostringstream reason;
  if (!std::isfinite(step.increment)) {
    reason << "the increment is not a number";
  } else if (!step.linear.is_converged) {
    reason << linear::describe_unconverged(step.linear);
    report_->is_linear_failure = true;
  } else if (part * step.relative_increment <= options_.relative_increment ||
             part * step.increment <= options_.absolute_increment) {
    return NOX::StatusTest::Converged;
  } else if (step.relative_increment > options_.growth_limit) {
    reason << "the increment grew to " << step.relative_increment << " times the first one";
  } else if (rule_->has_led_away() && !had_led_away_) {
    reason << "a step with an earlier Jacobian made the residual grow to " << step.residual;
  } else if (is_too_slow()) {
    report_->is_too_slow = true;
    reason << "the increment is still " << step.increment << " (" << step.relative_increment
           << " of the first) after " << report_->steps.size() << " iterations";
  } else {
    return NOX::StatusTest::Unconverged;
  }
  report_->reason = reason.str();
  return NOX::StatusTest::Failed;
}

NOX::StatusTest::StatusType IncrementTest::checkStatus(const NOX::Solver::Generic& solver,
                                                       NOX::StatusTest::CheckType) {
  // The test records each step, so it must look at all of them whatever NOX asks for.
  if (solver.getNumIterations() == 0) return status_ = NOX::StatusTest::Unconverged;
  if (static_cast<int>(report_->steps.size()) < solver.getNumIterations()) {
    record(solver);
    status_ = judge(solver);
  }
  return status_;
}

std::ostream& IncrementTest::print(std::ostream& stream, int indent) const {
  return stream << std::string(indent, ' ') << status_ << "mass norm of the increment\n";
}

}  // namespace tunica::nonlinear
