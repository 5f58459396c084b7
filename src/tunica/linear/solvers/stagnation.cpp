#include "tunica/linear/solvers/stagnation.hpp"

#include <cmath>

namespace tunica::linear {

bool StagnationRule::gives_up(const std::vector<double>& residuals, double goal) const {
  const auto k = static_cast<int>(residuals.size()) - 1;
  if (window == 0 || k < window) return false;
  // r_k > φ r_{k−w}   and   n = w log(r_k/τ)/log(r_{k−w}/r_k) > a + ρ log₁₀(r_k/τ)
  const double now = residuals[k], before = residuals[k - window];
  if (now <= factor * before) return false;
  const double to_come = window * std::log(now / goal) / std::log(before / now);
  const double by_another = allowance + rate * std::log10(now / goal);
  return !(to_come <= by_another);  // nor is it a number where nothing was gained
}

}  // namespace tunica::linear
