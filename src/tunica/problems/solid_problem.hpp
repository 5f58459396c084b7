#pragma once
#include "tunica/discretisation/solid.hpp"
#include "tunica/problems/field_problem.hpp"

namespace tunica::problems {

/// Options of the search for the prestress (prestress.hpp).
struct PrestressOptions {
  double pressure;                    ///< in the lumen of the image [kPa]; zero: no stress
  std::vector<std::string> surfaces;  ///< that bear it; none without it
  bool is_by_shape;                   ///< "stress-free shape"
  bool may_lean;                      ///< on the tissue, where needed
  int load_steps, max_iterations;
  double tolerance, linear_tolerance;
};

/// A resolved "Wall" list.
struct SolidSettings {
  SolidSettings(const Teuchos::ParameterList& list);  // NOLINT: a list is what is not decoded yet

  discretisation::SolidOptions options;
  SolveSettings solves;
  PrestressOptions prestress;
  Teuchos::ParameterList frame;  ///< "Fibre Frame"
};

/// The directions of each element of a wall that has a law with fibres; none for others. Throws as
/// fibre_frames(). Collective.
std::vector<materials::Frame> frames_of_wall(const SolidSettings& settings,
                                             const fields::FieldMesh& mesh);

/// The wall over time: one Newton solve for displacement and pressure of each step.
class SolidProblem final : public ProblemOf<discretisation::Solid> {
public:
  /// mesh must outlive the problem. Collective.
  SolidProblem(const SolidSettings& settings, const fields::FieldMesh& mesh);
  /// frames: as frames_of_wall() gives them.
  SolidProblem(const SolidSettings& settings, const fields::FieldMesh& mesh,
               std::vector<materials::Frame> frames);

  void begin_step(const stepping::Clock& clock) {
    forget_solves();
    field().begin_step(clock);
  }
  /// Solves the step for the present loads, started from the present state.
  /// The state at the start, of another run, with the velocity of the wall [mm/ms]. Laws take it
  /// for one in which the wall has been for long. Collective.
  void start_from(const algebra::BlockVector& x, const Vector& rate);
  nonlinear::NewtonReport solve();

  /// Displacement [mm] of the owned nodes within one time step under nodal forces [mN] on them,
  /// linearised at the present state. Fails with a reason if the linear solver is far from its
  /// tolerance. Comes after begin_step(), and sets up the solver for the Jacobian. Collective.
  Result<std::vector<Vec3>> solve_linearised(const std::vector<Vec3>& force);

  std::vector<Vec3> displacement() const;  ///< of owned nodes [mm]
  std::vector<Vec3> velocity() const;      ///< of owned nodes, of the last accepted step [mm/ms]
  discretisation::Observables observe() const { return field().observe(x_); }
  discretisation::Observables observe_surfaces(const std::vector<int>& surfaces) {
    return field().observe_surfaces(x_, surfaces);
  }

private:
  /// solve() where subscales see the divergence of the stress they belong to.
  nonlinear::NewtonReport find_equilibrium();
};

params::Table solid_table();
/// The keys of its "Linear Solver". By default a multigrid cycle with incomplete factors in node
/// blocks. As the mesh gets finer A turns from mass to elasticity, for which the cycles of the
/// block preconditioner need more sweeps than those of the fluid.
params::Table solid_solver_table();

}  // namespace tunica::problems
