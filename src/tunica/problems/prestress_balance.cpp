#include "tunica/problems/prestress_balance.hpp"

#include <Teuchos_Array.hpp>
#include <algorithm>

#include "tunica/base/error.hpp"
#include "tunica/boundary/registry.hpp"
#include "tunica/linear/direct_factor.hpp"
#include "tunica/linear/setup_failure.hpp"
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

/// Springs that alone hold a wall keep the matrix regular; what they bear is left over.
constexpr double part_of_springs = 1e-3;

void raise_loads(ParameterList& surfaces) {
  for (auto it = surfaces.begin(); it != surfaces.end(); ++it) {
    ParameterList& condition = surfaces.sublist(surfaces.name(it));
    if (condition.isParameter("stiffness"))
      condition.set("stiffness", part_of_springs * condition.get<double>("stiffness"));
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

/// Those that the case gives the surfaces which bear the pressure of the image come after it.
void leave_out_pressures(const std::vector<std::string>& bearing, ParameterList& surfaces) {
  for (auto it = surfaces.begin(); it != surfaces.end(); ++it) {
    ParameterList& condition = surfaces.sublist(surfaces.name(it));
    if (condition.get<std::string>("condition") != "pressure") continue;
    const auto& given = condition.get<std::string>("surface");
    const std::string surface = given.empty() ? surfaces.name(it) : given;
    if (std::count(bearing.begin(), bearing.end(), surface) > 0) condition.set("pressure", 0.0);
  }
}

/// The wall in equilibrium with its loads and a pressure on some surfaces.
ParameterList static_list(const ParameterList& list) {
  ParameterList wall(list);
  wall.set("analysis", "static");
  leave_out_pressures(prestress_surfaces(list), wall.sublist("Surfaces"));
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
  return wall;
}

}  // namespace

PrestressBalance::PrestressBalance(const ParameterList& list, const SolidProblem& wall)
    : wall_(static_list(list), wall.mesh(), wall.field().frames()),
      tolerance_(list.sublist("Prestress").get<double>("linear tolerance")) {
  wall_.field().stay_on_mesh();
}

Outcome PrestressBalance::residual(double load, const algebra::BlockVector& state,
                                   algebra::BlockVector& R) {
  wall_.take(state);
  wall_.begin_step(stepping::Clock(load, 1));
  return wall_.residual(state, R);
}

/// A direction that leaves no more of the residual than that will do: the step is judged by R.
constexpr double direction_residual = 0.5;

Result<int> PrestressBalance::solve(const algebra::BlockVector& R, algebra::BlockVector& dx) {
  try {
    wall_.jacobian(wall_.state());
    const linear::SolveReport report = wall_.linear_solver().solve(R, dx, tolerance_);
    wall_.hold_prescribed(dx);
    if (report.is_converged || report.true_residual < direction_residual) return report.iterations;
    return Result<int>::failure(linear::describe_unconverged(report));
  } catch (const linear::SetupFailure& error) {
    return Result<int>::failure(error.what());
  }
}

}  // namespace tunica::problems
