#pragma once
#include "tunica/base/outcome.hpp"
#include "tunica/problems/solid_problem.hpp"

namespace tunica::problems {

/// Imbalance of a wall in the position of its mesh, under a part of the pressure in its lumen and
/// of its loads at the start:
///
///   R(G, p)      G  prestretch of its elements, p  pressure
///
/// with Newton's step by s in G ← (I + sym ∇s) G. Springs of the tissue that are at rest add
/// nothing to R; a thousandth of their stiffness is in the Jacobian, so that it is regular where
/// they alone hold the wall. Where the wall leans on them they have all of it, and add k o to R, o
/// their stretch, to which s is added, too.
class PrestressBalance {
public:
  /// leans: on the springs of the tissue. Throws Error where a surface is displaced at the start.
  /// Collective.
  PrestressBalance(const SolidSettings& settings, const SolidProblem& wall, bool leans = false);

  /// R at this part of the loads; state: no displacement, and p. Collective.
  Outcome residual(double load, const algebra::BlockVector& state, algebra::BlockVector& R);
  /// The Jacobian of the last residual() times dx is R, to the tolerance of the case; the
  /// iterations that it took. Fails where the linear solver comes nowhere near. Collective.
  Result<int> solve(const algebra::BlockVector& R, algebra::BlockVector& dx);

  /// Takes the prestretch.
  SolidProblem& wall() { return wall_; }

private:
  SolidProblem wall_;
  double tolerance_;
};

}  // namespace tunica::problems
