#pragma once
#include <memory>

#include "tunica/discretisation/mixed_field.hpp"
#include "tunica/discretisation/observable.hpp"
#include "tunica/fields/state.hpp"
#include "tunica/nonlinear/newton.hpp"
#include "tunica/problems/watched_solver.hpp"

namespace tunica::problems {

/// Solver settings in the resolved list of a field.
struct SolveSettings {
  explicit SolveSettings(const Teuchos::ParameterList& field);

  nonlinear::NewtonOptions newton;
  Teuchos::ParameterList linear_solver;
};

/// One field alone: a discretisation with a state, Newton's method and a linear solver.
class FieldProblem : public nonlinear::NonlinearProblem,
                     public SystemSource,
                     public fields::Restartable {
public:
  FieldProblem(std::unique_ptr<discretisation::MixedField> field, const SolveSettings& settings);
  ~FieldProblem() override;

  const fields::FieldMesh& mesh() const { return field_->mesh(); }
  /// Whose nodes carry the scalars, see discretisation::MixedField.
  const fields::FieldMesh& scalar_mesh() const { return field_->scalar_mesh(); }
  const fields::NodeGraph& scalar_graph() const { return field_->scalar_graph(); }
  /// Null where that is the mesh.
  const fields::SplitMesh* split() const { return field_->split(); }
  const algebra::BlockVector& state() const { return x_; }
  /// Makes x the present state: what a coupled problem has found for all of its fields.
  void take(const algebra::BlockVector& x) { x_.assign(x); }
  /// Prescribed unknowns, per local node.
  const assembly::Constraints& constraints() const { return field_->constraints(); }
  const Throughput& jacobian_throughput() const { return field_->throughput(); }

  /// watch is called with each step of Newton's method.
  void watch_newton(nonlinear::NewtonWatch watch) { newton_.watch = std::move(watch); }

  // SystemSource
  void watch_solves(SolveWatch watch) override;
  const fields::BlockOperator& last_jacobian() const override { return field_->jacobian(); }
  const linear::NamedOperators& operators() const override { return *field_; }

  /// For a system that the field is part of, see discretisation::MixedField.
  void add_jacobian(const algebra::BlockVector& x, const assembly::Whole& whole) {
    field_->add_jacobian(x, whole);
  }
  const std::shared_ptr<algebra::LowRank>& products() const { return field_->products(); }

  const stepping::TimeScheme& time_scheme() const { return field_->time_scheme(); }
  /// Accepts the present state as that of the new time.
  virtual void end_step() { field_->end_step(x_); }

  // Restartable: the state, and what is remembered from step to step
  fields::State save() const override;
  std::string restore(const fields::State& state) override;
  std::map<std::string, fields::Restartable*> inner_parts() override;

  // NonlinearProblem
  const algebra::BlockSpacePtr& space() const override { return field_->space(); }
  Outcome residual(const algebra::BlockVector& x, algebra::BlockVector& F) override {
    return field_->residual(x, F);
  }
  void jacobian(const algebra::BlockVector& x) override;
  void apply_jacobian(const algebra::BlockVector& x, algebra::BlockVector& y) const override {
    field_->jacobian().apply(x, y);
  }
  /// Made when it is first asked for: a field that others solve for does without.
  linear::LinearSolver& linear_solver() override;
  void hold_prescribed(algebra::BlockVector& dx) const override { field_->hold_prescribed(dx); }
  double increment_norm(const algebra::BlockVector& dx) override { return field_->mass_norm(dx); }

protected:
  /// Where a step begins. Jacobians and preconditioners are kept within steps alone: a run that
  /// goes on from a checkpoint does what it would have done, to the last digit.
  void forget_solves();
  /// Newton's method from the present state, which is restored if it fails. Values prescribed by a
  /// step or an iteration are kept.
  nonlinear::NewtonReport find_state() { return find_state(newton_); }
  nonlinear::NewtonReport find_state(const nonlinear::NewtonOptions& options);
  const nonlinear::NewtonOptions& newton() const { return newton_; }

  algebra::BlockVector x_;

private:
  std::unique_ptr<discretisation::MixedField> field_;
  nonlinear::NewtonOptions newton_;
  nonlinear::JacobianRule rule_;
  Teuchos::ParameterList solver_list_;
  std::unique_ptr<linear::LinearSolver> solver_;  ///< null before it is asked for
};

/// A problem whose field is known by its own type.
template <class Field>
class ProblemOf : public FieldProblem {
public:
  Field& field() { return *own_; }
  const Field& field() const { return *own_; }

  /// From now on steps leave their balance.
  void keep_balance() { keeps_balance_ = true; }
  /// Of the last step.
  const discretisation::Balance& balance() const { return balance_; }
  void end_step() override {
    if (keeps_balance_) balance_ = own_->balance(x_);
    FieldProblem::end_step();
  }

protected:
  ProblemOf(std::unique_ptr<Field> field, const SolveSettings& settings)
      : ProblemOf(field.get(), std::move(field), settings) {}

private:
  ProblemOf(Field* own, std::unique_ptr<Field>&& field, const SolveSettings& settings)
      : FieldProblem(std::move(field), settings), own_(own) {}

  Field* const own_;  ///< that of the base
  bool keeps_balance_ = false;
  discretisation::Balance balance_;
};

}  // namespace tunica::problems
