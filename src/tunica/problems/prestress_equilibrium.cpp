#include "tunica/problems/prestress_equilibrium.hpp"

#include <Teuchos_Array.hpp>

#include "tunica/base/error.hpp"
#include "tunica/boundary/registry.hpp"
#include "tunica/problems/prestress.hpp"
#include "tunica/stepping/time_function.hpp"

namespace tunica::problems {

namespace {

using Teuchos::ParameterList;

/// Rises from zero to a value at time one: time is the part of the loads.
ParameterList rising_to(double value) {
  ParameterList amplitude;
  amplitude.set("kind", "table")
      .set("times", Teuchos::Array<double>(std::vector<double>{0.0, 1.0}))
      .set("values", Teuchos::Array<double>(std::vector<double>{0.0, value}));
  stepping::time_function_table().resolve(amplitude, "Prestress", "");
  return amplitude;
}

void raise_loads(ParameterList& surfaces) {
  for (auto it = surfaces.begin(); it != surfaces.end(); ++it) {
    ParameterList& condition = surfaces.sublist(surfaces.name(it));
    if (!condition.isSublist("Amplitude")) continue;
    const double at_start = stepping::TimeFunction(condition.sublist("Amplitude"))(0.0);
    const bool is_displaced = condition.isParameter("displacement") && at_start != 0.0;
    TUNICA_CHECK(!is_displaced,
                 "Wall / Surfaces / " + surfaces.name(it) +
                     ": it is displaced at the start, but with a prestress the wall begins where "
                     "its mesh lies. Let the amplitude begin with zero.");
    condition.sublist("Amplitude") = rising_to(at_start);
  }
}

/// The wall in equilibrium with its loads and a pressure on some surfaces.
ParameterList static_list(const ParameterList& list) {
  ParameterList wall(list);
  wall.set("analysis", "static");
  raise_loads(wall.sublist("Surfaces"));
  for (const std::string& surface : prestress_surfaces(list)) {
    ParameterList load;
    load.set("surface", surface)
        .set("condition", "pressure")
        .set("pressure", list.sublist("Prestress").get<double>("pressure"));
    load.sublist("Amplitude") = rising_to(1.0);
    boundary::condition_table("", boundary::wall_conditions()).resolve(load, "Prestress", "");
    wall.sublist("Surfaces").sublist("prestress of " + surface) = load;
  }
  // What an equilibrium lacks is out of balance in the next one, which starts anew from the mesh.
  wall.sublist("Newton")
      .set("stop at", "next increment")
      .set("safety", 1.0)
      .set("relative increment", 0.1)
      .set("max iterations", 10)
      .set("growth limit", 100.0)
      .set("jacobian cost", 0.0)
      .set("line search", "guarded")
      .set("forcing", "constant")
      .set("linear tolerance", list.sublist("Prestress").get<double>("linear tolerance"));
  return wall;
}

}  // namespace

PrestressEquilibrium::PrestressEquilibrium(const ParameterList& list, const SolidProblem& wall)
    : wall_(static_list(list), wall.mesh(), wall.frames()) {}

nonlinear::NewtonReport PrestressEquilibrium::solve(double load,
                                                    const algebra::BlockVector& start) {
  wall_.take(start);
  wall_.begin_step(stepping::Clock(load, 1));
  return wall_.solve();
}

}  // namespace tunica::problems
