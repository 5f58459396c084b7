#pragma once
#include "tunica/problems/solid_problem.hpp"

namespace tunica::problems {

/// Equilibria of a wall under a part of the pressure in its lumen and of the loads that it has at
/// the start, as the search for its prestress needs them: near the mesh, and no more accurate than
/// the next one, which starts from what is out of balance then, has use for.
class PrestressEquilibrium {
public:
  /// list: the resolved "Wall" list. Throws Error where a surface is displaced at the start.
  /// Collective.
  PrestressEquilibrium(const Teuchos::ParameterList& list, const SolidProblem& wall);

  /// From the mesh, with these pressures for a start. Collective.
  nonlinear::NewtonReport solve(double load, const algebra::BlockVector& start);
  /// The wall, where the last one has left it.
  SolidProblem& wall() { return wall_; }

private:
  SolidProblem wall_;
};

}  // namespace tunica::problems
