#pragma once
#include <functional>
#include <memory>

#include "tunica/discretisation/mixed_field.hpp"
#include "tunica/fields/state.hpp"
#include "tunica/nonlinear/newton.hpp"

namespace tunica::problems {

/// One field alone: a discretisation with a state, Newton's method and a linear solver.
class FieldProblem : public nonlinear::NonlinearProblem, public fields::Restartable {
public:
  /// list: the resolved "Fluid" or "Wall" list, for its "Newton" and its "Linear Solver".
  FieldProblem(std::unique_ptr<discretisation::MixedField> field,
               const Teuchos::ParameterList& list);
  ~FieldProblem() override;

  const fields::FieldMesh& mesh() const { return field_->mesh(); }
  /// Whose nodes carry the scalars, see discretisation::MixedField.
  const fields::FieldMesh& scalar_mesh() const { return field_->scalar_mesh(); }
  /// Null where that is the mesh.
  const fields::SplitMesh* split() const { return field_->split(); }
  const algebra::BlockVector& state() const { return x_; }
  /// The Jacobian assembled last, and the operators that belong to it.
  const fields::BlockOperator& last_jacobian() const { return field_->jacobian(); }
  const linear::NamedOperators& operators() const { return *field_; }
  const Throughput& jacobian_throughput() const { return field_->throughput(); }

  /// Calls watch with the right-hand side before each linear solve. The Jacobian and the named
  /// operators are then those of the system.
  using SolveWatch = std::function<void(const algebra::BlockVector& b)>;
  void watch_solves(SolveWatch watch);

  const stepping::TimeScheme& time_scheme() const { return field_->time_scheme(); }
  /// Accepts the present state as that of the new time.
  void end_step() { field_->end_step(x_); }

  // Restartable: the state by the names of its blocks, and what is remembered from step to step
  fields::State save() const override;
  std::string restore(const fields::State& state) override;
  std::map<std::string, fields::Restartable*> inner_parts() override;

  // NonlinearProblem
  const algebra::BlockSpacePtr& space() const override { return field_->space(); }
  bool residual(const algebra::BlockVector& x, algebra::BlockVector& F) override {
    return field_->residual(x, F);
  }
  void jacobian(const algebra::BlockVector& x) override;
  void apply_jacobian(const algebra::BlockVector& x, algebra::BlockVector& y) const override {
    field_->jacobian().apply(x, y);
  }
  linear::LinearSolver& linear_solver() override { return *solver_; }
  double increment_norm(const algebra::BlockVector& dx) override { return field_->mass_norm(dx); }
  std::string refusal() const override { return field_->refusal(); }

protected:
  /// Newton's method from the present state, to which it goes back where it fails. What a step or
  /// an iteration prescribes stays.
  nonlinear::NewtonReport find_state();

  discretisation::MixedField& discretisation() { return *field_; }

  algebra::BlockVector x_;

private:
  /// The block stands on the nodes of split().
  bool is_split(const algebra::Block& block) const {
    return split() != nullptr && block.components == 1;
  }

  std::unique_ptr<discretisation::MixedField> field_;
  nonlinear::NewtonOptions newton_;
  std::unique_ptr<linear::LinearSolver> solver_;
};

}  // namespace tunica::problems
