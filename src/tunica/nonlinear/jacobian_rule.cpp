#include "tunica/nonlinear/jacobian_rule.hpp"

#include <algorithm>
#include <cmath>

#include "tunica/nonlinear/newton.hpp"

namespace tunica::nonlinear {

double steps_to(double goal, double increment, double rate) {
  if (increment <= goal) return 1.0;
  if (rate >= 0.9) return 1e9;
  return std::ceil(std::log(increment / goal) / -std::log(rate));
}

bool JacobianRule::wants_new(const std::vector<NewtonStep>& steps, double goal) const {
  if (cost_ == 0.0 || !has_jacobian_ || has_led_away_) return true;
  if (rate_ == 0.0) return false;  // new, and nobody knows yet how good
  const double e = steps.empty() ? first_increment_ : steps.back().increment;
  if (!(goal > 0.0) || !(e > 0.0)) return true;
  return steps_to(goal, e, rate_) > cost_ + steps_to(goal, e, std::min(rate_, new_rate_));
}

void JacobianRule::renewed() {
  has_jacobian_ = true;
  steps_since_ = 0;
  rate_ = 0.0;
}

void JacobianRule::note(const std::vector<NewtonStep>& steps) {
  ++steps_since_;
  const std::size_t n = steps.size();
  if (n == 1) first_increment_ = steps.front().increment;
  // An increment over one that an older Jacobian gave says how good that one was.
  if (n < 2 || steps_since_ < 2 || !(steps[n - 2].increment > 0.0)) return;
  const double rate = std::max(1e-6, steps[n - 1].increment / steps[n - 2].increment);
  if (rate_ == 0.0) new_rate_ = rate;
  rate_ = rate;
  // Twice: what old Jacobians and round-off do near a solution is less.
  if (steps[n - 1].residual > 2.0 * steps[n - 2].residual) has_led_away_ = true;
}

}  // namespace tunica::nonlinear
