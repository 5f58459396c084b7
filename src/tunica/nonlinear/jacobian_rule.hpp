#pragma once
#include <vector>

#include "tunica/params/table.hpp"

namespace tunica::nonlinear {

struct NewtonStep;

/// When Newton's method takes a new Jacobian, and when it goes on with the last one: its increments
/// e_k then fall by a part ρ of a decade each. The steps to a goal g that are left are
///
///   log(e/g)/log(1/ρ)  with the old one,   c + log(e/g)/log(1/ρ₀)  with a new one,
///
/// the smaller number wins. ρ is what the last step has shown, ρ₀ what the first two steps with a
/// new Jacobian have, and c what a new one costs in steps. The rule outlives the solves of one
/// problem.
class JacobianRule {
public:
  /// cost: c; 0 takes a new one in each step.
  explicit JacobianRule(double cost) : cost_(cost) {}

  /// steps: those of the solve so far; goal: of the increments, absolute.
  bool wants_new(const std::vector<NewtonStep>& steps, double goal) const;
  void renewed();
  /// A step was made, the last one of these.
  void note(const std::vector<NewtonStep>& steps);
  /// Makes the next step take a new one: the old one has led nowhere.
  void forget() { has_jacobian_ = false; }

  /// A solve that failed might have succeeded with new ones.
  bool has_lagged() const { return steps_since_ > 1; }

private:
  double cost_;
  bool has_jacobian_ = false;
  int steps_since_ = 0;           ///< with the present one, over all solves
  double rate_ = 0.0;             ///< ρ; 0: not known
  double new_rate_ = 1e-2;        ///< ρ₀
  double first_increment_ = 0.0;  ///< of the last solve
};

}  // namespace tunica::nonlinear
