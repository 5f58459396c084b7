#pragma once
#include <functional>
#include <memory>
#include <optional>

#include "tunica/assembly/solid_assembly.hpp"
#include "tunica/problems/field_problem.hpp"
#include "tunica/problems/observable.hpp"
#include "tunica/problems/solid_options.hpp"
#include "tunica/stepping/clock.hpp"

namespace tunica::problems {

/// The wall over time: displacement and pressure of one step by Newton's method, Newmark
/// between the steps. Loads are follower pressures, dead tractions and nodal forces from the
/// fluid. Starts at rest in the unloaded configuration.
class SolidProblem : public FieldProblem {
public:
  using VectorField = std::function<Vec3(const Vec3& X, double time)>;

  /// list: the resolved "Wall" list. mesh must outlive the problem.
  SolidProblem(const Teuchos::ParameterList& list, const fields::FieldMesh& mesh);
  ~SolidProblem() override;

  void begin_step(const stepping::Clock& clock);
  /// Nodal forces [mN] on the owned nodes, which stay until the next call.
  void set_nodal_force(const std::vector<Vec3>& force) { nodal_force_ = force; }
  /// Solves the step for the present loads, started from the present state.
  nonlinear::NewtonReport solve();
  /// Accepts the present state as that of the new time.
  void end_step();

  /// What nodal forces [mN] on the owned nodes displace the owned nodes by within one time step
  /// [mm], linearised at the present state. Nothing, and reason says why, where the linear solver
  /// fails. Begins the clock's present step and sets up the solver for its Jacobian. Collective.
  std::optional<std::vector<Vec3>> respond(const stepping::Clock& clock,
                                           const std::vector<Vec3>& force, std::string& reason);

  /// Body force per mass at the undeformed position [mm/ms²], none by default; for verification.
  void set_body_force(VectorField f) { body_force_ = std::move(f); }

  std::vector<Vec3> displacement() const;  ///< of owned nodes [mm]
  std::vector<Vec3> velocity() const;      ///< of owned nodes, of the last accepted step [mm/ms]
  const assembly::SolidElements& elements() const { return elements_; }

  Observables observe() const;

  // FieldProblem
  fields::State save() const override;
  std::string restore(const fields::State& state) override;
  std::string refusal() const override {
    return refusal_.empty() ? "the residual is not a number" : refusal_;
  }

  // NamedOperators: the parts of the paper's Schur complement
  std::vector<std::string> operator_names() const override;
  Teuchos::RCP<const CrsMatrix> assemble_operator(const std::string& name) const override;

private:
  void set_constraints();
  void set_elements();
  void set_layer_boundaries();
  void set_frames(const Teuchos::ParameterList& list);
  void set_coefficients(double dt);
  void set_inertia_history();
  void add_body_force();
  void read(const algebra::BlockVector& x) override;
  bool is_admissible() override;
  void assemble(assembly::BlockAssembler* K) override;
  const std::vector<kernels::Tet4>& geometry() const override { return elements_.geometry; }
  void add_surface_loads(const std::vector<Vec3>& d, assembly::BlockAssembler* K);
  double alpha_of(const Layer& layer) const;

  SolidOptions options_;
  std::vector<std::unique_ptr<materials::HyperelasticLaw>> laws_;  ///< per layer
  std::vector<int> layer_of_region_;
  std::vector<char> is_at_layer_;  ///< per element: it touches another material
  std::vector<const WallCondition*> condition_of_surface_;
  assembly::SolidElements elements_;

  assembly::SolidFields local_;              ///< ghosted copy of the point of evaluation
  std::vector<Vec3> d_old_, v_old_, a_old_;  ///< owned and ghost nodes
  std::vector<Vec3> nodal_force_;
  VectorField body_force_;
  double time_ = 0.0;
  double dt_ = 0.0;
  std::string refusal_;
};

}  // namespace tunica::problems
