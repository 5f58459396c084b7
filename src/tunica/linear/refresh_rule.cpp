#include "tunica/linear/refresh_rule.hpp"

#include <algorithm>
#include <cmath>

namespace tunica::linear {

namespace {

/// Half a decade at least: a solve that hardly had to do anything tells little.
double decades(double reduction) { return std::max(0.5, -std::log10(std::max(reduction, 1e-16))); }

}  // namespace

double RefreshRule::cap(double tolerance) const {
  return 2.0 * rate_ * decades(tolerance) + allowance_ + 10.0;
}

void RefreshRule::renew() {
  has_rate_ = false;
  lost_ = 0.0;
}

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
