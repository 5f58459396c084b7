#include "problems/mesh_motion.hpp"

#include <sstream>

#include "assembly/gather.hpp"
#include "assembly/scalar_matrix.hpp"
#include "kernels/laplace_p1.hpp"

namespace tunica::problems {

MeshMotion::MeshMotion(const Teuchos::ParameterList& list, const fields::FieldMesh& mesh,
                       const std::vector<int>& surfaces)
    : mesh_(&mesh), kind_(mesh.n_nodes(), Kind::free), solution_(mesh.node_map, 3),
      d_(mesh.n_nodes()), d_old_(mesh.n_nodes()) {
  for (int a = 0; a < mesh.n_nodes(); ++a) {
    if (mesh.on_surface[a] != 0) kind_[a] = Kind::fixed;
    for (const int s : surfaces)
      if (mesh.is_on(a, s)) kind_[a] = Kind::interface;
  }
  assemble();
  solver_ = linear::make_scalar_solver(list.sublist("Linear Solver"), K_);
}

void MeshMotion::assemble() {
  const fields::NodeGraph graph = fields::make_node_graph(*mesh_);
  const auto element = [this](std::size_t e) {
    return kernels::laplace_p1(kernels::make_tet4(assembly::gather(mesh_->x, mesh_->tets[e])));
  };
  std::vector<char> is_given(mesh_->n_nodes()), none(mesh_->n_nodes(), 0);
  for (int a = 0; a < mesh_->n_nodes(); ++a) is_given[a] = kind_[a] != Kind::free;
  K_ = assembly::scalar_matrix(*mesh_, graph, element, is_given);
  whole_ = assembly::scalar_matrix(*mesh_, graph, element, none);
}

std::optional<std::string> MeshMotion::extend(const std::vector<Vec3>& interface_displacement) {
  MultiVector given(mesh_->node_map, 3), right_side(mesh_->node_map, 3);
  {
    const auto view = given.getLocalViewHost(overwrite_all);
    for (int a = 0; a < mesh_->n_owned; ++a)
      for (int i = 0; i < 3; ++i)
        view(a, i) = kind_[a] == Kind::interface ? interface_displacement[a][i] : 0.0;
  }
  whole_->apply(given, right_side, Teuchos::NO_TRANS, -1.0, 0.0);
  {
    const auto view = right_side.getLocalViewHost(read_write);
    for (int a = 0; a < mesh_->n_owned; ++a)
      for (int i = 0; i < 3; ++i)
        if (kind_[a] != Kind::free) view(a, i) = 0.0;
  }
  const double residual = solver_->solve(right_side, solution_);
  if (!(residual <= 2.0 * solver_->tolerance())) {
    std::ostringstream text;
    text << "the linear solver left a relative residual of " << residual << " instead of "
         << solver_->tolerance();
    return text.str();
  }
  MultiVector total(solution_, Teuchos::Copy);
  total.update(1.0, given, 1.0);
  MultiVector ghosted(mesh_->ghosted_map, 3);
  ghosted.doImport(total, *mesh_->import, insert);
  const auto view = ghosted.getLocalViewHost(read_only);
  for (int a = 0; a < mesh_->n_nodes(); ++a) d_[a] = {view(a, 0), view(a, 1), view(a, 2)};
  return std::nullopt;
}

params::Table mesh_motion_table() {
  params::Table table("Harmonic extension of the wall's displacement into the fluid's mesh.");
  table.sublist("Linear Solver", linear::scalar_solver_table());
  return table;
}

}  // namespace tunica::problems
