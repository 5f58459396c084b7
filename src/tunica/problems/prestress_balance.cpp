#include "tunica/problems/prestress_balance.hpp"

#include <Teuchos_Array.hpp>
#include <algorithm>

#include "tunica/base/error.hpp"
#include "tunica/boundary/registry.hpp"
#include "tunica/linear/direct/direct_factor.hpp"
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

// Every load becomes λ times what it is at the start. A wall that stays on its mesh has no
// displacements to be raised.
void raise_loads(bool leans, std::vector<boundary::Condition>& conditions) {
  for (boundary::Condition& condition : conditions) {
    ParameterList& list = condition.list;
    if (list.isParameter("stiffness") && !leans)
      list.set("stiffness", part_of_springs * list.get<double>("stiffness"));
    if (!list.isSublist("Amplitude")) continue;
    const double at_start = stepping::TimeFunction(list.sublist("Amplitude"))(0.0);
    const bool is_displaced = list.isParameter("displacement") && at_start != 0.0;
    TUNICA_CHECK(!is_displaced,
                 "Wall / Surfaces / " + condition.surface +
                     ": it is displaced at the start, but with a prestress the wall begins where "
                     "its mesh lies. Let the amplitude begin with zero.");
    list.sublist("Amplitude") = rising_to(at_start);
  }
}

/// Those that the case gives the surfaces which bear the pressure of the image come after it.
void leave_out_pressures(const std::vector<std::string>& bearing,
                         std::vector<boundary::Condition>& conditions) {
  for (boundary::Condition& condition : conditions)
    if (condition.kind() == "pressure" &&
        std::count(bearing.begin(), bearing.end(), condition.surface) > 0)
      condition.list.set("pressure", 0.0);
}

/// The wall in equilibrium with its loads and a pressure on some surfaces.
SolidSettings in_equilibrium(const SolidSettings& settings, bool leans) {
  SolidSettings wall(settings);
  wall.options = discretisation::in_statics(settings.options);
  std::vector<boundary::Condition>& conditions = wall.options.conditions;
  leave_out_pressures(settings.prestress.surfaces, conditions);
  raise_loads(leans, conditions);
  // λ p₀ on each of its surfaces
  for (const std::string& surface : settings.prestress.surfaces) {
    ParameterList load;
    load.set("surface", surface)
        .set("condition", "pressure")
        .set("pressure", settings.prestress.pressure);
    load.sublist("Amplitude") = rising_to(1.0);
    boundary::condition_table("", boundary::wall_conditions()).resolve(load, "Prestress", "");
    conditions.push_back({surface, load});
  }
  return wall;
}

}  // namespace

PrestressBalance::PrestressBalance(const SolidSettings& settings, const SolidProblem& wall,
                                   bool leans)
    : wall_(in_equilibrium(settings, leans), wall.mesh(), wall.field().frames()),
      tolerance_(settings.prestress.linear_tolerance) {
  wall_.field().stay_on_mesh();
  // λ f, as all loads
  const Vec3 f = settings.options.body_force;
  if (norm(f) > 0.0)
    wall_.field().set_body_force([f](const Vec3&, double part) { return part * f; });
}

Outcome PrestressBalance::residual(double load, const algebra::BlockVector& state,
                                   algebra::BlockVector& R) {
  // Statics of the wall where it lies, at d = 0; the clock's time is the part of the loads.
  wall_.take(state);
  wall_.begin_step(stepping::Clock(load, 1));
  return wall_.residual(state, R);
}

/// A direction that leaves no more of the residual than that will do: the step is judged by R.
constexpr double direction_residual = 0.5;

// K δ = R with K of the last residual; s = −δ is the caller's
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
