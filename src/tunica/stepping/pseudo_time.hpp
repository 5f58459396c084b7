#pragma once
#include <limits>
#include <vector>

#include "tunica/params/table.hpp"

namespace tunica::stepping {

/// Sizes of steps that lead to a steady state, of which only the end counts:
///
///   Δtⁿ⁺¹ = Δtⁿ g,   g = rⁿ⁻¹/rⁿ between two bounds,   r = ‖xⁿ − xⁿ⁻¹‖/Δtⁿ
///
/// r is what the time derivative leaves of the steady equations. Once a step changes x by little,
/// the next ones are infinite, or as long as is permitted: Newton's method for the steady
/// equations, from a state nearby. Where such a step fails, or infinite ones do not settle, shorter
/// ones go on. Source: [MK], switched evolution relaxation.
class PseudoTime {
public:
  /// From a resolved "Time" list of a steady flow.
  explicit PseudoTime(const Teuchos::ParameterList& time);

  /// Size of the present step, finally the largest.
  double size() const { return size_; }
  /// A step of the largest size has changed x by no more than is permitted.
  bool is_steady() const { return is_steady_; }

  /// The present step has failed. False where it has been cut too often.
  bool cut();
  /// The present step has changed x by so many times what is permitted of a steady state.
  void advance(double change);

  std::vector<double> save() const;
  void restore(const std::vector<double>& numbers);

private:
  void watch_infinite_steps(double change);

  double largest_;  ///< infinite where nothing forbids it
  double size_, last_grown_;
  double smallest_growth_, largest_growth_;
  double infinite_below_;  ///< change over what is permitted of a steady state
  int most_cuts_;
  double last_rate_ = 0.0;
  int cuts_ = 0;  ///< of the present step
  /// Of infinite steps: the change that was last half of the one before it, and how many steps ago.
  double halved_change_ = std::numeric_limits<double>::infinity();
  int since_halved_ = 0;
  bool is_steady_ = false;
};

/// The keys of a "Time" list of a steady flow.
params::Table steady_table();

}  // namespace tunica::stepping
