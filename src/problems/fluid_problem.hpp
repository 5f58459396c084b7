#pragma once
#include <functional>
#include <memory>
#include <optional>

#include "assembly/fluid_assembly.hpp"
#include "base/timer.hpp"
#include "nonlinear/newton.hpp"
#include "problems/fluid_options.hpp"
#include "problems/observable.hpp"
#include "stepping/clock.hpp"

namespace tunica::problems {

/// The fluid on a moving mesh over time: velocity and pressure of one step by Newton's method,
/// implicit Euler between the steps. Starts at rest on the undeformed mesh.
class FluidProblem : public nonlinear::NonlinearProblem, public linear::NamedOperators {
public:
  using VectorField = std::function<Vec3(const Vec3& x, double time)>;

  /// list: the resolved "Fluid" list. mesh must outlive the problem.
  FluidProblem(const Teuchos::ParameterList& list, const fields::FieldMesh& mesh);
  ~FluidProblem() override;

  /// Accepts the present velocity as that of the old time.
  void begin_step(const stepping::Clock& clock);
  /// Moves the mesh to the displacement d of all local nodes; the mesh velocity and the
  /// velocity on the interface are (d − d_old)/Δt. Says which element is inverted, if one is.
  std::optional<std::string> set_domain(const std::vector<Vec3>& d, const std::vector<Vec3>& d_old);
  /// Imposes the prescribed velocities and fixes what stays constant in a Newton solve, which
  /// solve() does by itself.
  void prepare();
  nonlinear::NewtonReport solve();

  /// Consistent nodal forces [mN] on what bounds the fluid: minus the momentum residual of the
  /// last solve, on owned nodes. Meaningful where the velocity is prescribed.
  std::vector<Vec3> reaction();

  /// Replaces body force per mass, initial velocity, and velocity on "velocity" surfaces by
  /// functions; for verification.
  void set_body_force(VectorField f) { body_force_ = std::move(f); }
  void set_boundary_velocity(VectorField u) { boundary_velocity_ = std::move(u); }
  void set_initial_velocity(const std::function<Vec3(const Vec3& x)>& u);

  const fields::BlockVector& state() const { return x_; }
  const FluidOptions& options() const { return options_; }
  const std::vector<Vec3>& positions() const { return position_; }  ///< current, local nodes
  const assembly::FluidElements& elements() const { return elements_; }

  Observables observe() const;
  /// Elements of all Jacobians so far and the time they took on this rank.
  const Meter& jacobian_meter() const { return meter_; }

  // NonlinearProblem
  const fields::FieldMesh& mesh() const override { return *mesh_; }
  bool residual(const fields::BlockVector& x, fields::BlockVector& F) override;
  void jacobian(const fields::BlockVector& x) override;
  void apply_jacobian(const fields::BlockVector& x, fields::BlockVector& y) const override;
  linear::LinearSolver& linear_solver() override { return *solver_; }
  double increment_norm(const fields::BlockVector& dx) override;
  std::string refusal() const override { return "the residual is not a number"; }

  // NamedOperators: the parts of the paper's Schur complement
  std::vector<std::string> operator_names() const override;
  Teuchos::RCP<const CrsMatrix> assemble_operator(const std::string& name) const override;

private:
  void set_constraints();
  void impose_velocities();
  void check_closed_flow() const;
  Vec3 prescribed_velocity(int node, const FlowCondition& condition, int surface) const;
  void assemble(const fields::BlockVector& x, assembly::BlockAssembler* K);
  void add_surface_terms(assembly::BlockAssembler* K);

  FluidOptions options_;
  nonlinear::NewtonOptions newton_;
  const fields::FieldMesh* mesh_;
  std::vector<const FlowCondition*> condition_of_surface_;
  struct Round {
    Vec3 centre;
    double radius;
  };
  std::vector<Round> round_;  ///< per surface, for parabolic profiles
  assembly::FluidElements elements_;
  assembly::Constraints fixed_;
  fields::BlockOperator K_;
  std::unique_ptr<linear::LinearSolver> solver_;
  assembly::NodalResidual R_;
  VectorField body_force_, boundary_velocity_;

  fields::BlockVector x_;
  std::vector<Vec3> position_;
  assembly::FluidFields local_;  ///< ghosted copies; u and p at the point of evaluation
  bool is_closed_ = false;       ///< no surface lets the fluid out
  double time_ = 0.0;
  Meter meter_;
};

}  // namespace tunica::problems
