#include "tunica/problems/harmonic.hpp"

#include <sstream>

#include "tunica/assembly/scalar_matrix.hpp"

namespace tunica::problems {

Harmonic::Harmonic(const Teuchos::ParameterList& solver, const fields::FieldMesh& mesh,
                   std::vector<char> is_given, int columns)
    : mesh_(&mesh), is_given_(std::move(is_given)), solution_(mesh.node_map, columns) {
  const fields::NodeGraph graph = fields::make_node_graph(mesh);
  K_ = assembly::laplacian(mesh, mesh.x, graph, is_given_);
  whole_ = assembly::laplacian(mesh, mesh.x, graph, std::vector<char>(mesh.n_nodes(), 0));
  solver_ = linear::make_scalar_solver(solver, K_);
}

std::optional<std::string> Harmonic::extend(MultiVector& values) {
  MultiVector right_side(mesh_->node_map, values.getNumVectors());
  whole_->apply(values, right_side, Teuchos::NO_TRANS, -1.0, 0.0);
  {
    const auto view = right_side.getLocalViewHost(read_write);
    for (int a = 0; a < mesh_->n_owned; ++a)
      for (std::size_t j = 0; j < view.extent(1); ++j)
        if (is_given_[a]) view(a, j) = 0.0;
  }
  const double residual = solver_->solve(right_side, solution_);
  if (!(residual <= 2.0 * solver_->tolerance())) {
    std::ostringstream text;
    text << "the linear solver left a relative residual of " << residual << " instead of "
         << solver_->tolerance();
    solution_.putScalar(0.0);  // it may be no number, and is the next start
    return text.str();
  }
  values.update(1.0, solution_, 1.0);
  return std::nullopt;
}

void Harmonic::start_from(const MultiVector& values) {
  solution_.assign(values);
  const auto view = solution_.getLocalViewHost(read_write);
  for (int a = 0; a < mesh_->n_owned; ++a)
    for (std::size_t j = 0; j < view.extent(1); ++j)
      if (is_given_[a]) view(a, j) = 0.0;
}

}  // namespace tunica::problems
