#include "tunica/problems/field_problem.hpp"

namespace tunica::problems {

SolveSettings::SolveSettings(const Teuchos::ParameterList& field)
    : newton(nonlinear::newton_options(field.sublist("Newton"))),
      linear_solver(field.sublist("Linear Solver")) {}

FieldProblem::FieldProblem(std::unique_ptr<discretisation::MixedField> field,
                           const SolveSettings& settings)
    : x_(field->space()), field_(std::move(field)), newton_(settings.newton),
      rule_(newton_.jacobian_cost), solver_list_(settings.linear_solver) {}

FieldProblem::~FieldProblem() = default;

linear::LinearSolver& FieldProblem::linear_solver() {
  if (!solver_) solver_ = linear::make_linear_solver(solver_list_, field_->jacobian(), *field_);
  return *solver_;
}

void FieldProblem::watch_solves(SolveWatch watch) {
  linear_solver();
  solver_ = watched(std::move(solver_), std::move(watch));
}

// Blocks by their names, a row for each vertex, so that a state does not depend on the ranks.
fields::State FieldProblem::save() const {
  fields::State state = fields::state_on(mesh());
  for (int b = 0; b < x_.n_blocks(); ++b)
    state.arrays[(*space())[b].name] = fields::rows_of(x_, b, split());
  if (solver_) save_solver(*solver_, split(), state);
  field_->save_history(state);
  return state;
}

std::string FieldProblem::restore(const fields::State& state) {
  for (int b = 0; b < x_.n_blocks(); ++b) {
    const algebra::Block& block = (*space())[b];
    const int length = fields::row_length(block, split());
    fields::assign_rows(state.array(block.name, length), b, split(), x_);
  }
  // Numbers of a solver need one to go to; without any it is made when it is first asked for.
  if (solver_ || has_solver(state, *space()))
    restore_solver(state, space(), split(), linear_solver());
  return field_->restore_history(state, x_);
}

std::map<std::string, fields::Restartable*> FieldProblem::inner_parts() {
  return field_->element_histories();
}

// K and P of a step serve its Newton steps alone.
void FieldProblem::forget_solves() {
  rule_ = nonlinear::JacobianRule(newton_.jacobian_cost);
  if (solver_) solver_->forget();
}

// x ← x − K⁻¹ F(x) on a copy: where that fails the state is the last one that was found.
nonlinear::NewtonReport FieldProblem::find_state(const nonlinear::NewtonOptions& options) {
  algebra::BlockVector x(space());
  x.assign(x_);
  nonlinear::NewtonReport report = solve_newton(*this, options, x, &rule_);
  if (report.is_converged) x_.assign(x);
  return report;
}

// What was set up for the last K may serve the new one; the solver's rule decides.
void FieldProblem::jacobian(const algebra::BlockVector& x) {
  field_->assemble_jacobian(x);
  if (solver_) solver_->matrix_changed();
}

}  // namespace tunica::problems
