#pragma once
#include "tunica/linear/solvers/stagnation.hpp"

namespace tunica::linear {

/// When to set up a preconditioner anew, as far as the iterations tell: when those lost by keeping
/// the old one sum up to what a new one costs. Whatever comes within a time step, that is at most
/// twice the least possible effort. The measure is iterations per decade of the residual, for the
/// tolerances of Newton's method change from solve to solve.
class RefreshRule {
public:
  /// factor: of the cost; 0 always wants a new one. cost: of a set-up, in iterations.
  RefreshRule(double factor, double cost) : allowance_(factor * cost) {}

  /// True before a solve with a new matrix if the preconditioner should be new too.
  bool wants_new() const { return !has_rate_ || lost_ >= allowance_; }
  /// Iterations after which an old preconditioner has failed in a solve to that tolerance.
  double cap(double tolerance) const;
  /// When a solve with an old one ends for a new one that goes on from there.
  StagnationRule when_to_give_up() const;

  /// The preconditioner is new, could not be made, or is not to serve any more.
  void renew();
  /// Records the preconditioner's work in a solve; reduction: |b − Kx|/|b| reached.
  void note(int iterations, double reduction, bool is_converged);

private:
  double allowance_;
  bool has_rate_ = false;
  double rate_ = 0.0;  ///< iterations per decade of a new preconditioner
  double lost_ = 0.0;  ///< iterations since
};

}  // namespace tunica::linear
