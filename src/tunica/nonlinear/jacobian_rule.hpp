#pragma once
#include <vector>

namespace tunica::nonlinear {

struct NewtonStep;

/// Steps that take increments, of which each is the part rate of the one before, to the goal; as
/// many as there are numbers where they hardly fall.
double steps_to(double goal, double increment, double rate);

/// When Newton's method takes a new Jacobian, and when it goes on with the last one: its increments
/// e_k are then a part ρ each of the one before. The steps to a goal g that are left are
///
///   log(e/g)/log(1/ρ)  with the old one,   c + log(e/g)/log(1/ρ₀)  with a new one,
///
/// the smaller number wins. ρ is what the last step has shown, ρ₀ what the first two steps with a
/// new Jacobian have, and c what a new one costs in steps. An old one with which a step has made
/// the residual grow has led away: from then on each step takes a new one. The rule outlives the
/// solves of one time step.
class JacobianRule {
public:
  /// cost: c; 0 takes a new one in each step.
  explicit JacobianRule(double cost) : cost_(cost) {}

  /// steps: those of the solve so far; goal: of the increments, absolute.
  bool wants_new(const std::vector<NewtonStep>& steps, double goal) const;
  void begin_solve() { has_lagged_ = false; }
  void renewed();
  /// The last one serves again.
  void kept() { has_lagged_ = has_lagged_ || steps_since_ > 0; }
  /// A step was made, the last one of these.
  void note(const std::vector<NewtonStep>& steps);
  /// Makes the next step take a new one: the old one has led nowhere.
  void forget() { has_jacobian_ = false; }

  /// An old one has, in this time step; what it led to is of no use.
  bool has_led_away() const { return has_led_away_; }
  /// A solve that failed might have succeeded with new ones.
  bool has_lagged() const { return has_lagged_; }

private:
  double cost_;
  bool has_jacobian_ = false;
  bool has_lagged_ = false;       ///< in the present solve
  bool has_led_away_ = false;     ///< in the present time step
  int steps_since_ = 0;           ///< with the present one, over all solves
  double rate_ = 0.0;             ///< ρ; 0: not known
  double new_rate_ = 1e-2;        ///< ρ₀
  double first_increment_ = 0.0;  ///< of the last solve
};

}  // namespace tunica::nonlinear
