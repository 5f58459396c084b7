#pragma once
#include <vector>

namespace tunica::linear {

/// When a solve is given up for another preconditioner. With residuals r₀, r₁, … r_k of the
/// iterations, relative to the right side, and the goal τ:
///
///   r_k > φ r_{k−w}   and   n = w log(r_k/τ) / log(r_{k−w}/r_k) > a + ρ log₁₀(r_k/τ)
///
/// no factor 1/φ in the last w iterations, and at that pace n more to come, which are more than the
/// other preconditioner takes: a, what it costs, and its own iterations from here, where they are
/// known. A solve that is slow but will end before is left alone.
struct StagnationRule {
  int window = 0;          ///< w; 0: nothing is given up
  double factor = 0.1;     ///< φ
  double allowance = 0.0;  ///< a, in iterations
  double rate = 0.0;       ///< ρ, iterations per decade; 0: not known

  /// residuals: of all iterations so far, r₀ first.
  bool gives_up(const std::vector<double>& residuals, double goal) const;
};

}  // namespace tunica::linear
