#pragma once
#include "tunica/discretisation/fluid.hpp"
#include "tunica/problems/field_problem.hpp"

namespace tunica::problems {

/// The fluid over time: one Newton solve for velocity and pressure of each step.
class FluidProblem final : public FieldProblem {
public:
  /// list: the resolved "Fluid" list. mesh must outlive the problem. Collective.
  FluidProblem(const Teuchos::ParameterList& list, const fields::FieldMesh& mesh);

  void begin_step(const stepping::Clock& clock) {
    forget_solves();
    fluid_->begin_step(clock);
  }
  /// discretisation::Fluid::set_domain().
  Outcome set_domain(const std::vector<Vec3>& d, const std::vector<Vec3>& d_past) {
    return fluid_->set_domain(d, d_past);
  }
  /// Imposes the prescribed velocities and fixes what stays constant in a Newton solve, which
  /// solve() does by itself.
  void prepare() { prescribe(x_); }
  void prescribe(algebra::BlockVector& x) { fluid_->prescribe(x); }
  /// Where the velocity on the interface is solved for: see discretisation::Fluid.
  void release_interface(const std::vector<Mat3>& free) { fluid_->release_interface(free); }
  void fix_coefficients() { fluid_->fix_coefficients(); }
  nonlinear::NewtonReport solve();

  /// See discretisation::Fluid.
  void assemble_shape_jacobian(const algebra::BlockVector& x) {
    fluid_->assemble_shape_jacobian(x);
  }
  const assembly::FluidShapeMatrix& shape_jacobian() const { return fluid_->shape_jacobian(); }

  /// discretisation::Fluid::reaction() of the last solve.
  std::vector<Vec3> reaction() { return fluid_->reaction(x_); }

  /// Replaces body force per mass, initial velocity, and velocity on "velocity" surfaces by
  /// functions; for verification.
  void set_body_force(boundary::VectorField f) { fluid_->set_body_force(std::move(f)); }
  void set_boundary_velocity(boundary::VectorField u) {
    fluid_->set_boundary_velocity(std::move(u));
  }
  void set_initial_velocity(const std::function<Vec3(const Vec3& x)>& u);
  /// A pressure that is the same everywhere, zero by default [kPa]. It is where the first step
  /// begins to look for its own.
  void set_initial_pressure(double p);

  /// discretisation::Fluid::wall_shear_stress() of the last solve.
  std::vector<Vec3> wall_shear_stress() { return fluid_->wall_shear_stress(x_); }

  double density() const { return fluid_->density(); }
  std::vector<int> open_surfaces() const { return fluid_->open_surfaces(); }
  std::vector<int> staying_surfaces() const { return fluid_->staying_surfaces(); }
  const std::vector<Vec3>& positions() const { return fluid_->positions(); }
  const assembly::FluidElements& elements() const { return fluid_->elements(); }
  discretisation::Observables observe() const { return fluid_->observe(x_); }
  discretisation::Observables observe_surfaces(const std::vector<int>& surfaces) {
    return fluid_->observe_surfaces(x_, surfaces);
  }

private:
  FluidProblem(std::unique_ptr<discretisation::Fluid> fluid, const Teuchos::ParameterList& list);

  discretisation::Fluid* const fluid_;  ///< that of the base
};

params::Table fluid_table();
/// The keys of its "Linear Solver".
params::Table fluid_solver_table();

}  // namespace tunica::problems
