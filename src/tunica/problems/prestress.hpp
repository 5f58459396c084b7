#pragma once
#include <functional>

#include "tunica/base/outcome.hpp"
#include "tunica/problems/solid_problem.hpp"

namespace tunica::problems {

/// A vessel is imaged under pressure, and its mesh is not free of stress. Sought is the shape X
/// without stress which the loads of the wall and a pressure p in the lumen deform to the mesh x:
///
///   X + d(X) = x,   d(X): equilibrium of the wall that is free of stress in X
///
/// By the fixed point X ← X − (X + d(X) − x), whose error falls by the size of the strain in each
/// iteration, and faster with what the last ones have changed; the pressure is raised in steps.
/// Works with any law, as each iteration is an equilibrium as any other. Source: [Se11].
struct Prestress {
  std::vector<Vec3> from_stress_free;  ///< x − X on owned nodes [mm]
  algebra::BlockVector state;          ///< no displacement, and the pressure that bears the load
};

/// One of its iterations.
struct PrestressIteration {
  int load_step, iteration;
  double load;     ///< part of the pressure
  double moved;    ///< largest displacement from the mesh [mm]
  double largest;  ///< |x − X| [mm]
};

/// list: the resolved "Wall" list; wall: on the mesh, gives its fibres. Fails where an equilibrium
/// is not found, X is inverted somewhere, or the iteration does not end. Collective.
Result<Prestress> find_prestress(const Teuchos::ParameterList& list, const SolidProblem& wall,
                                 const std::function<void(const PrestressIteration&)>& report);

/// True where the "Wall" list asks for it.
bool wants_prestress(const Teuchos::ParameterList& list);
std::vector<std::string> prestress_surfaces(const Teuchos::ParameterList& list);

params::Table prestress_table();

}  // namespace tunica::problems
