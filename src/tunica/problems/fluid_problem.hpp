#pragma once
#include "tunica/discretisation/fluid.hpp"
#include "tunica/problems/field_problem.hpp"

namespace tunica::problems {

/// A resolved "Fluid" list.
struct FluidSettings {
  FluidSettings(const Teuchos::ParameterList& list);  // NOLINT: a list is what is not decoded yet

  discretisation::FluidOptions options;
  SolveSettings solves;
};

/// The fluid over time: one Newton solve for velocity and pressure of each step.
class FluidProblem final : public ProblemOf<discretisation::Fluid> {
public:
  /// mesh must outlive the problem. Collective.
  FluidProblem(const FluidSettings& settings, const fields::FieldMesh& mesh);

  void begin_step(const stepping::Clock& clock) {
    forget_solves();
    field().begin_step(clock);
  }
  /// Imposes the prescribed velocities and fixes what stays constant in a Newton solve, which
  /// solve() does by itself.
  void prepare() { field().prescribe(x_); }
  nonlinear::NewtonReport solve();

  /// The state at the start, of another run: its velocity is the first step's past.
  void start_from(const algebra::BlockVector& x) {
    take(x);
    field().start_from(x_);
  }
  /// For verification. The velocity at the start, zero by default.
  void set_initial_velocity(const std::function<Vec3(const Vec3& x)>& u);
  /// A pressure that is the same everywhere, zero by default [kPa]. It is where the first step
  /// begins to look for its own.
  void set_initial_pressure(double p);

  // Of the last solve: see discretisation::Fluid.
  std::vector<Vec3> reaction() { return field().reaction(x_); }
  std::vector<Vec3> wall_shear_stress() { return field().wall_shear_stress(x_); }
  discretisation::Observables observe() const { return field().observe(x_); }
  discretisation::Observables observe_surfaces(const std::vector<int>& surfaces) {
    return field().observe_surfaces(x_, surfaces);
  }
};

params::Table fluid_table();
/// The keys of its "Linear Solver".
params::Table fluid_solver_table();

}  // namespace tunica::problems
