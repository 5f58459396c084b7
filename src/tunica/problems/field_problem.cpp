#include "tunica/problems/field_problem.hpp"

#include "tunica/assembly/mass_norm.hpp"

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

FieldProblem::FieldProblem(const Teuchos::ParameterList& list, const fields::FieldMesh& mesh)
    : mesh_(&mesh), fixed_(mesh.n_nodes(), 0), K_(mesh), R_(mesh), x_(fields::zero_vector(mesh)),
      newton_(nonlinear::newton_options(list.sublist("Newton"))) {}

FieldProblem::~FieldProblem() = default;

void FieldProblem::make_solver(const Teuchos::ParameterList& list) {
  solver_ = linear::make_linear_solver(list.sublist("Linear Solver"), K_, *this);
}

void FieldProblem::watch_solves(SolveWatch watch) {
  solver_ = std::make_unique<WatchedSolver>(std::move(solver_), std::move(watch));
}

fields::State FieldProblem::save() const {
  fields::State state = fields::state_on(*mesh_);
  state.arrays["vector"] = fields::rows_of(x_[0], 3);
  state.arrays["scalar"] = fields::rows_of(x_[1], 1);
  return state;
}

std::string FieldProblem::restore(const fields::State& state) {
  fields::assign_rows(state.array("vector", 3), x_[0]);
  fields::assign_rows(state.array("scalar", 1), x_[1]);
  read(x_);
  return "";
}

nonlinear::NewtonReport FieldProblem::find_state() {
  algebra::BlockVector x = fields::zero_vector(*mesh_);
  x.assign(x_);
  nonlinear::NewtonReport report = solve_newton(*this, newton_, x);
  if (report.is_converged)
    x_.assign(x);
  else
    read(x_);
  return report;
}

bool FieldProblem::residual(const algebra::BlockVector& x, algebra::BlockVector& F) {
  read(x);
  if (!is_admissible()) return false;
  assemble(nullptr);
  R_.store(*mesh_, fixed_, F);
  return true;
}

void FieldProblem::jacobian(const algebra::BlockVector& x) {
  read(x);
  const Stopwatch watch;
  assembly::BlockAssembler assembler(K_, fixed_);
  assemble(&assembler);
  assembler.finish();
  meter_.items += static_cast<long long>(mesh_->tets.size());
  meter_.seconds += watch.seconds();
  solver_->matrix_changed();
}

void FieldProblem::apply_jacobian(const algebra::BlockVector& x, algebra::BlockVector& y) const {
  K_.apply(x, y);
}

double FieldProblem::increment_norm(const algebra::BlockVector& dx) {
  return assembly::mass_norm(*mesh_, geometry(), dx);
}

}  // namespace tunica::problems
