#include "problems/mesh_motion.hpp"

#include <stdexcept>

#include "assembly/gather.hpp"
#include "fields/block_operator.hpp"
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
  K_ = fields::make_matrix(graph, *mesh_, 1, 1);
  coupling_ = fields::make_matrix(graph, *mesh_, 1, 1);
  K_->resumeFill();
  coupling_->resumeFill();
  {
    const auto K = K_->getLocalMatrixHost().values;
    const auto coupling = coupling_->getLocalMatrixHost().values;
    for (std::size_t e = 0; e < mesh_->tets.size(); ++e) {
      const auto& nodes = mesh_->tets[e];
      const auto Ke = kernels::laplace_p1(kernels::make_tet4(assembly::gather(mesh_->x, nodes)));
      for (int a = 0; a < 4; ++a) {
        if (nodes[a] >= mesh_->n_owned) continue;
        for (int b = 0; b < 4; ++b) {
          const std::size_t k = graph.row_start[nodes[a]] + graph.position[e][4 * a + b];
          const bool are_free = kind_[nodes[a]] == Kind::free && kind_[nodes[b]] == Kind::free;
          if (are_free || a == b) K(k) += Ke[a][b];
          if (kind_[nodes[a]] == Kind::free && kind_[nodes[b]] == Kind::interface)
            coupling(k) += Ke[a][b];
        }
      }
    }
  }
  K_->fillComplete(mesh_->node_map, mesh_->node_map);
  coupling_->fillComplete(mesh_->node_map, mesh_->node_map);
}

const std::vector<Vec3>& MeshMotion::extend(const std::vector<Vec3>& interface_displacement) {
  MultiVector given(mesh_->node_map, 3), right_side(mesh_->node_map, 3);
  {
    const auto view = given.getLocalViewHost(Tpetra::Access::OverwriteAll);
    for (int a = 0; a < mesh_->n_owned; ++a)
      for (int i = 0; i < 3; ++i)
        view(a, i) = kind_[a] == Kind::interface ? interface_displacement[a][i] : 0.0;
  }
  coupling_->apply(given, right_side, Teuchos::NO_TRANS, -1.0, 0.0);
  const double residual = solver_->solve(right_side, solution_);
  if (!(residual < 1e-8))
    throw std::runtime_error("Mesh Motion: the linear solver left a relative residual of " +
                             std::to_string(residual) + ".");
  MultiVector total(solution_, Teuchos::Copy);
  total.update(1.0, given, 1.0);
  MultiVector ghosted(mesh_->ghosted_map, 3);
  ghosted.doImport(total, *mesh_->import, Tpetra::INSERT);
  const auto view = ghosted.getLocalViewHost(Tpetra::Access::ReadOnly);
  for (int a = 0; a < mesh_->n_nodes(); ++a) d_[a] = {view(a, 0), view(a, 1), view(a, 2)};
  return d_;
}

params::Table mesh_motion_table() {
  params::Table table("Harmonic extension of the wall's displacement into the fluid's mesh.");
  table.sublist("Linear Solver", linear::scalar_solver_table());
  return table;
}

}  // namespace tunica::problems
