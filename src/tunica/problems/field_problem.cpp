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

fields::State FieldProblem::save() const {
  fields::State state = fields::state_on(mesh());
  for (int b = 0; b < x_.n_blocks(); ++b) state.arrays[(*space())[b].name] = rows_of(x_, b);
  if (solver_) save_solver(*solver_, state);
  field_->save_history(state);
  return state;
}

std::string FieldProblem::restore(const fields::State& state) {
  for (int b = 0; b < x_.n_blocks(); ++b) {
    const algebra::Block& block = (*space())[b];
    const int columns = is_split(block) ? split()->n_copies : block.components;
    assign_rows(state.array(block.name, columns), b, x_);
  }
  if (solver_ || has_solver(state)) restore_solver(state, linear_solver());
  return field_->restore_history(state, x_);
}

fields::State::Array FieldProblem::rows_of(const algebra::BlockVector& x, int block) const {
  const algebra::Block& of = (*space())[block];
  return is_split(of) ? fields::rows_of(x[block], *split())
                      : fields::rows_of(x[block], of.components);
}

void FieldProblem::assign_rows(const fields::State::Array& rows, int block,
                               algebra::BlockVector& x) const {
  if (is_split((*space())[block]))
    fields::assign_rows(rows, *split(), x[block]);
  else
    fields::assign_rows(rows, x[block]);
}

std::map<std::string, fields::Restartable*> FieldProblem::inner_parts() {
  return field_->element_histories();
}

void FieldProblem::forget_solves() {
  rule_ = nonlinear::JacobianRule(newton_.jacobian_cost);
  if (solver_) solver_->forget();
}

nonlinear::NewtonReport FieldProblem::find_state(const nonlinear::NewtonOptions& options) {
  algebra::BlockVector x(space());
  x.assign(x_);
  nonlinear::NewtonReport report = solve_newton(*this, options, x, &rule_);
  if (report.is_converged) x_.assign(x);
  return report;
}

void FieldProblem::jacobian(const algebra::BlockVector& x) {
  field_->assemble_jacobian(x);
  if (solver_) solver_->matrix_changed();
}

}  // namespace tunica::problems
