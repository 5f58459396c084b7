#include "tunica/linear/refresh_rule.hpp"

#include <algorithm>
#include <cmath>

namespace tunica::linear {

namespace {

/// Half a decade at least: a solve that hardly had to do anything tells little.
double decades(double reduction) { return std::max(0.5, -std::log10(std::max(reduction, 1e-16))); }

/// Iterations whose pace tells what is to come; the first of a solve often gain little.
constexpr int pace_over = 5;

}  // namespace

// 2 ρ log₁₀(1/τ) + L + 10: twice what a new one needs, and what it costs to set up
double RefreshRule::cap(double tolerance) const {
  return 2.0 * rate_ * decades(tolerance) + allowance_ + 10.0;
}

StagnationRule RefreshRule::when_to_give_up() const { return {pace_over, 0.0, allowance_, rate_}; }

void RefreshRule::renew() {
  has_rate_ = false;
  lost_ = 0.0;
}

// ρ from the first solve. Later ones lose k − max(1, ρ log₁₀(1/reduction)), where that is positive;
// one that fails calls for a new preconditioner at once.
void RefreshRule::note(int iterations, double reduction, bool is_converged) {
  if (!is_converged) {
    renew();
  } else if (!has_rate_) {
    rate_ = iterations / decades(reduction);
    has_rate_ = true;
  } else {
    lost_ += std::max(0.0, iterations - std::max(1.0, rate_ * decades(reduction)));
  }
}

}  // namespace tunica::linear
