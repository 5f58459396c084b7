#pragma once
#include <functional>
#include <memory>
#include <optional>

#include "tunica/assembly/fluid_assembly.hpp"
#include "tunica/problems/field_problem.hpp"
#include "tunica/problems/fluid_options.hpp"
#include "tunica/problems/observable.hpp"
#include "tunica/problems/surface_geometry.hpp"
#include "tunica/stepping/clock.hpp"

namespace tunica::problems {

/// The fluid on a moving mesh over time: velocity and pressure of one step by Newton's method,
/// implicit Euler between the steps. Starts at rest on the undeformed mesh.
class FluidProblem : public FieldProblem {
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

  double density() const { return options_.density; }  ///< [mg/mm³]
  /// Indices into FieldMesh::surfaces: where the fluid may pass. Collective.
  std::vector<int> open_surfaces() const;

  const std::vector<Vec3>& positions() const { return position_; }  ///< current, local nodes
  const assembly::FluidElements& elements() const { return elements_; }

  Observables observe() const;

  // FieldProblem
  std::string refusal() const override { return "the residual is not a number"; }

  // NamedOperators: the parts of the paper's Schur complement
  std::vector<std::string> operator_names() const override;
  Teuchos::RCP<const CrsMatrix> assemble_operator(const std::string& name) const override;

private:
  void set_constraints();
  void impose_velocities();
  /// Volume of fluid that leaves through the face [mm³/ms]; u on local nodes.
  double outflow(const fields::Face& face, const std::vector<Vec3>& u) const;
  void check_closed_flow() const;
  Vec3 prescribed_velocity(int node, const FlowCondition& condition, int surface) const;
  void read(const algebra::BlockVector& x) override;
  void assemble(assembly::BlockAssembler* K) override;
  const std::vector<kernels::Tet4>& geometry() const override { return elements_.geometry; }
  /// Traction that the condition of an open surface exerts on the triangle x at present [kPa].
  Vec3 traction_on(const std::array<Vec3, 3>& x, const FlowCondition& condition) const;
  void add_surface_terms(assembly::BlockAssembler* K);
  void observe_volume(const assembly::FluidFields& state, Observables& found) const;
  void observe_open_surfaces(const std::vector<Vec3>& u, Observables& found) const;

  FluidOptions options_;
  std::vector<const FlowCondition*> condition_of_surface_;
  std::vector<SurfaceGeometry> round_;  ///< per surface, for parabolic profiles
  assembly::FluidElements elements_;
  VectorField body_force_, boundary_velocity_;

  std::vector<Vec3> position_;
  assembly::FluidFields local_;  ///< ghosted copies; u and p at the point of evaluation
  bool is_closed_ = false;       ///< no surface lets the fluid out
  double time_ = 0.0;
};

}  // namespace tunica::problems
