#pragma once
#include <memory>

#include "tunica/fields/embed_field.hpp"
#include "tunica/fields/interface_transfer.hpp"
#include "tunica/problems/coupled_settings.hpp"
#include "tunica/problems/fluid_problem.hpp"
#include "tunica/problems/mesh_motion.hpp"
#include "tunica/problems/solid_problem.hpp"

namespace tunica::problems {

/// Fluid and wall as one nonlinear system over the vertices of both:
///
///   x = (y, p)    y  the fluid's velocity; in the wall ẋ of its displacement d, as the fluid's
///                    time scheme sees it: d = d̃ + Δt y [mm/ms]
///                 p  pressures of lumen and wall, two of them on the interface [kPa]
///
/// so that u = ḋ on the interface says that both fields have the same y there. The equations are
/// those of the fields; momentum balances add up on the interface, and the wall's continuity is
/// divided by Δt. With the fluid's K_f and the wall's K_s
///
///   K = [ A    B1ᵀ ] = [ A_f + Δt A_s   B1ᵀ_f, B1ᵀ_s     ]
///       [ B2  −C   ]   [ B2_f, B2_s    −C_f, −C_s / Δt   ]
///
/// is one generalised Stokes matrix whose inertia and stiffness jump at the interface. What F makes
/// of the domain that moves with d is not in these blocks; with exact shape derivatives it is
/// beside them, by its products with vectors.
class CoupledProblem final : public nonlinear::NonlinearProblem,
                             public SystemSource,
                             public linear::NamedOperators {
public:
  /// The fields, and the mesh of both of them. They must outlive the object.
  struct Parts {
    const fields::FieldMesh& mesh;
    const fields::InterfaceTransfer& interface;
    FluidProblem& fluid;
    SolidProblem& wall;
    MeshMotion& motion;
  };
  /// The fluid's interface is released.
  /// Throws Error where the wall has conditions that no coupled system can have. Collective.
  CoupledProblem(const CoupledSettings& settings, const Parts& parts);
  ~CoupledProblem() override;

  /// Begins the clock's present step in all fields. Fails where the extrapolated domain is none.
  /// Collective.
  Outcome begin_step(const stepping::Clock& clock);
  /// Whether Jacobians have shape derivatives from the next solve on: with "geometry" = "newton"
  /// they have, else not until told; never where the domain is extrapolated. A solve that has not
  /// converged in so many steps without them, or would not, goes on with them; 0: it never does.
  void want_shape_derivatives(bool wanted, int most_steps_without) {
    wants_shape_derivatives_ = wanted;
    most_steps_without_ = most_steps_without;
  }
  /// watch is called with each step of Newton's method.
  void watch_newton(nonlinear::NewtonWatch watch) { newton_.watch = std::move(watch); }
  /// Newton's method from these states of the fields; on success they are those of the new time,
  /// else they stay what they were, unless wants_any is true and all steps that are permitted have
  /// led to a state that is admissible, though not accurate. Collective.
  struct Solution {
    nonlinear::NewtonReport newton;
    bool is_taken;               ///< the states are those of the new time
    bool has_gone_over = false;  ///< to shape derivatives, after steps without
  };
  Solution solve(const algebra::BlockVector& fluid, const algebra::BlockVector& wall,
                 bool wants_any);
  /// Repeats a failed solve: steps are shortened until the residual falls, each with a new Jacobian
  /// with shape derivatives, and four times as many are permitted.
  Solution solve_carefully(const algebra::BlockVector& fluid, const algebra::BlockVector& wall,
                           bool wants_any);
  /// Accepts the present states as those of the new time. Fails, and says why, where the mesh
  /// cannot follow. Collective.
  Outcome accept();

  /// Where the time of the step went.
  struct Seconds {
    double motion = 0.0, fluid = 0.0, wall = 0.0, matrix = 0.0;
  };
  const Seconds& seconds() const { return seconds_; }

  // NonlinearProblem
  const algebra::BlockSpacePtr& space() const override { return K_->space(); }
  Outcome residual(const algebra::BlockVector& x, algebra::BlockVector& F) override;
  void jacobian(const algebra::BlockVector& x) override;
  void apply_jacobian(const algebra::BlockVector& x, algebra::BlockVector& y) const override {
    K_->apply(x, y);
  }
  linear::LinearSolver& linear_solver() override { return *solver_; }
  const linear::LinearSolver& present_solver() const { return *solver_; }
  void hold_prescribed(algebra::BlockVector& dx) const override;
  /// Root mean square of Δt |dy| over the vertices: how far the increment moves them [mm].
  double increment_norm(const algebra::BlockVector& dx) override;

  // SystemSource
  void watch_solves(SolveWatch watch) override;
  const fields::BlockOperator& last_jacobian() const override { return *K_; }
  const linear::NamedOperators& operators() const override { return *this; }

  // NamedOperators: "Schur Mass", the masses over the viscosity and over the moduli times Δt, and
  // what each field makes of the velocities' block of K
  std::vector<std::string> operator_names() const override;
  Teuchos::RCP<const CrsMatrix> assemble_operator(const std::string& name) const override;

private:
  class FollowingDomain;

  Solution solve(const nonlinear::NewtonOptions& options, nonlinear::JacobianRule& rule,
                 const algebra::BlockVector& fluid, const algebra::BlockVector& wall,
                 bool wants_any);
  /// Newton's method from and to x.
  nonlinear::NewtonReport find_root(const nonlinear::NewtonOptions& options,
                                    nonlinear::JacobianRule& rule, algebra::BlockVector& x);
  void tie_fields();
  void set_reference();
  /// Takes x apart.
  void read(const algebra::BlockVector& x);
  /// The mesh moves with wall_x_.
  Outcome follow_wall(const ExtensionAccuracy& accuracy);
  bool is_domain_of_wall() const;  ///< it has done so, and not elsewhere since; collective

  const fields::FieldMesh* mesh_;
  const fields::InterfaceTransfer* interface_;
  FluidProblem* fluid_;
  SolidProblem* wall_;
  MeshMotion* motion_;
  bool is_extrapolated_, wants_shape_derivatives_;
  int most_steps_without_ = 0;
  ExtensionAccuracy mesh_accuracy_;
  double product_tolerance_;
  bool knows_domain_;  ///< the present Jacobian has shape derivatives
  std::unique_ptr<fields::SplitMesh> split_;
  std::unique_ptr<fields::BlockOperator> K_;
  fields::FieldPlace fluid_place_, wall_place_;
  std::unique_ptr<algebra::Embedding> fluid_part_, wall_part_;
  nonlinear::NewtonOptions newton_;
  nonlinear::JacobianRule rule_;
  std::unique_ptr<linear::LinearSolver> solver_;

  algebra::BlockVector fluid_x_, wall_x_;  ///< of the fields, at the last point of evaluation
  algebra::BlockVector fluid_F_, wall_F_;
  algebra::BlockVector jacobian_fluid_x_, jacobian_wall_x_;  ///< where K was made
  algebra::BlockVector reference_;                           ///< (d̃, 0) of the wall
  Vector followed_;            ///< the wall's displacement with which the domain lies
  bool has_followed_ = false;  ///< in this step
  double dt_ = 0.0;            ///< Δt of y
  Seconds seconds_;
};

}  // namespace tunica::problems
