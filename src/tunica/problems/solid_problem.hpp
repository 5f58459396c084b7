#pragma once
#include "tunica/discretisation/solid.hpp"
#include "tunica/problems/field_problem.hpp"

namespace tunica::problems {

/// The directions of each element of a wall that has a law with fibres; none for others. list: the
/// resolved "Wall" list. Throws as fibre_frames(). Collective.
std::vector<materials::Frame> frames_of_wall(const Teuchos::ParameterList& list,
                                             const fields::FieldMesh& mesh);

/// The wall over time: one Newton solve for displacement and pressure of each step.
class SolidProblem final : public FieldProblem {
public:
  /// list: the resolved "Wall" list. mesh must outlive the problem. Collective.
  SolidProblem(const Teuchos::ParameterList& list, const fields::FieldMesh& mesh);
  /// frames: as frames_of_wall() gives them.
  SolidProblem(const Teuchos::ParameterList& list, const fields::FieldMesh& mesh,
               std::vector<materials::Frame> frames);

  /// discretisation::Solid::prestretch().
  const std::vector<Mat3>& prestretch() const { return wall_->prestretch(); }
  /// discretisation::Solid::set_prestretch(). Collective.
  Outcome set_prestretch(std::vector<Mat3> G) { return wall_->set_prestretch(std::move(G)); }
  /// discretisation::Solid::stay_on_mesh().
  void stay_on_mesh() { wall_->stay_on_mesh(); }
  void begin_step(const stepping::Clock& clock) {
    forget_solves();
    wall_->begin_step(clock);
  }
  /// Nodal forces [mN] on the owned nodes, which stay until the next call.
  void set_nodal_force(const std::vector<Vec3>& force) { wall_->set_nodal_force(force); }
  /// Solves the step for the present loads, started from the present state.
  nonlinear::NewtonReport solve();
  /// discretisation::Solid::prescribe().
  void prescribe(algebra::BlockVector& x) { wall_->prescribe(x); }

  /// What nodal forces [mN] on the owned nodes displace the owned nodes by within one time step
  /// [mm], linearised at the present state. Fails, and says why, where the linear solver comes
  /// nowhere near.
  /// Comes after begin_step(), and sets up the solver for the Jacobian. Collective.
  Result<std::vector<Vec3>> solve_linearised(const std::vector<Vec3>& force);

  /// Body force per mass at the undeformed position [mm/ms²], none by default; for verification.
  void set_body_force(boundary::VectorField f) { wall_->set_body_force(std::move(f)); }

  std::vector<Vec3> displacement() const;  ///< of owned nodes [mm]
  std::vector<Vec3> velocity() const;      ///< of owned nodes, of the last accepted step [mm/ms]
  const assembly::SolidElements& elements() const { return wall_->elements(); }
  /// Of the fibres in the mesh.
  const std::vector<materials::Frame>& frames() const { return wall_->frames(); }
  /// discretisation::Solid::pressure_parts().
  std::vector<int> pressure_parts() const { return wall_->pressure_parts(); }
  /// True where nodes of the surface move as one.
  bool moves_as_one(int surface) const { return wall_->moves_as_one(surface); }
  discretisation::Observables observe() const { return wall_->observe(x_); }
  discretisation::Observables observe_surfaces(const std::vector<int>& surfaces) {
    return wall_->observe_surfaces(x_, surfaces);
  }

private:
  SolidProblem(std::unique_ptr<discretisation::Solid> wall, const Teuchos::ParameterList& list);

  /// solve() where subscales see the divergence of the stress they belong to.
  nonlinear::NewtonReport find_equilibrium();

  discretisation::Solid* const wall_;  ///< that of the base
};

params::Table solid_table();
/// The keys of its "Linear Solver". By default a multigrid cycle with incomplete factors in node
/// blocks. As the mesh gets finer A turns from mass to elasticity, for which the cycles of the
/// block preconditioner need more sweeps than those of the fluid.
params::Table solid_solver_table();

}  // namespace tunica::problems
