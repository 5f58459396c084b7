#include "problems/field_problem.hpp"

#include "assembly/mass_norm.hpp"

namespace tunica::problems {

FieldProblem::FieldProblem(const Teuchos::ParameterList& list, const fields::FieldMesh& mesh)
    : mesh_(&mesh), fixed_(mesh.n_nodes(), 0), K_(mesh), R_(mesh), x_(mesh),
      newton_(nonlinear::newton_options(list.sublist("Newton"))) {}

FieldProblem::~FieldProblem() = default;

void FieldProblem::make_solver(const Teuchos::ParameterList& list) {
  solver_ = linear::make_linear_solver(list.sublist("Linear Solver"), K_, *this);
}

bool FieldProblem::residual(const fields::BlockVector& x, fields::BlockVector& F) {
  read(x);
  if (!is_admissible()) return false;
  assemble(nullptr);
  R_.store(*mesh_, fixed_, F);
  return true;
}

void FieldProblem::jacobian(const fields::BlockVector& x) {
  read(x);
  const Stopwatch watch;
  assembly::BlockAssembler assembler(K_, fixed_);
  assemble(&assembler);
  assembler.finish();
  meter_.items += static_cast<long long>(mesh_->tets.size());
  meter_.seconds += watch.seconds();
  solver_->matrix_changed();
}

void FieldProblem::apply_jacobian(const fields::BlockVector& x, fields::BlockVector& y) const {
  K_.apply(x, y);
}

double FieldProblem::increment_norm(const fields::BlockVector& dx) {
  return assembly::mass_norm(*mesh_, geometry(), dx);
}

}  // namespace tunica::problems
