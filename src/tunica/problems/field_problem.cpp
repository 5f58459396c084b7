#include "tunica/problems/field_problem.hpp"

namespace tunica::problems {

namespace {

/// A solver that shows each right-hand side before it solves.
class WatchedSolver final : public linear::LinearSolver {
public:
  WatchedSolver(std::unique_ptr<linear::LinearSolver> solver, FieldProblem::SolveWatch watch)
      : solver_(std::move(solver)), watch_(std::move(watch)) {}

  void matrix_changed() override { solver_->matrix_changed(); }
  void prepare() override { solver_->prepare(); }
  linear::SolveReport solve(const algebra::BlockVector& b, algebra::BlockVector& x,
                            double tolerance) override {
    watch_(b);
    return solver_->solve(b, x, tolerance);
  }

private:
  std::unique_ptr<linear::LinearSolver> solver_;
  FieldProblem::SolveWatch watch_;
};

}  // namespace

FieldProblem::FieldProblem(std::unique_ptr<discretisation::MixedField> field,
                           const Teuchos::ParameterList& list)
    : x_(field->space()), field_(std::move(field)),
      newton_(nonlinear::newton_options(list.sublist("Newton"))),
      solver_(
          linear::make_linear_solver(list.sublist("Linear Solver"), field_->jacobian(), *field_)) {}

FieldProblem::~FieldProblem() = default;

void FieldProblem::watch_solves(SolveWatch watch) {
  solver_ = std::make_unique<WatchedSolver>(std::move(solver_), std::move(watch));
}

fields::State FieldProblem::save() const {
  fields::State state = fields::state_on(mesh());
  for (int b = 0; b < x_.n_blocks(); ++b) {
    const algebra::Block& block = (*space())[b];
    state.arrays[block.name] = is_split(block) ? fields::rows_of(x_[b], *split())
                                               : fields::rows_of(x_[b], block.components);
  }
  field_->save_history(state);
  return state;
}

std::string FieldProblem::restore(const fields::State& state) {
  for (int b = 0; b < x_.n_blocks(); ++b) {
    const algebra::Block& block = (*space())[b];
    if (is_split(block))
      fields::assign_rows(state.array(block.name, split()->n_copies), *split(), x_[b]);
    else
      fields::assign_rows(state.array(block.name, block.components), x_[b]);
  }
  return field_->restore_history(state, x_);
}

std::map<std::string, fields::Restartable*> FieldProblem::inner_parts() {
  return field_->element_histories();
}

nonlinear::NewtonReport FieldProblem::find_state() {
  algebra::BlockVector x(space());
  x.assign(x_);
  nonlinear::NewtonReport report = solve_newton(*this, newton_, x);
  if (report.is_converged) x_.assign(x);
  return report;
}

void FieldProblem::jacobian(const algebra::BlockVector& x) {
  field_->assemble_jacobian(x);
  solver_->matrix_changed();
}

}  // namespace tunica::problems
