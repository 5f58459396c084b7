#include "tunica/discretisation/mesh_motion.hpp"

#include <cmath>

#include "tunica/assembly/element_geometry.hpp"
#include "tunica/assembly/scalar_matrix.hpp"
#include "tunica/base/reduce.hpp"
#include "tunica/kernels/energy.hpp"

namespace tunica::discretisation {

namespace {

std::vector<char> nodes_of_surfaces(const fields::FieldMesh& mesh) {
  std::vector<char> is_given(mesh.n_nodes());
  for (int a = 0; a < mesh.n_nodes(); ++a) is_given[a] = mesh.is_on_boundary(a);
  return is_given;
}

/// The components of a vector unknown as the columns of a nodal one, and back.
MultiVector columns_of(const fields::FieldMesh& mesh, const Vector& x) {
  MultiVector columns(mesh.node_map, 3);
  const auto from = x.getLocalViewHost(read_only);
  const auto to = columns.getLocalViewHost(overwrite_all);
  for (int a = 0; a < mesh.n_owned; ++a)
    for (int i = 0; i < 3; ++i) to(a, i) = from(3 * a + i, 0);
  return columns;
}

void assign_columns(const fields::FieldMesh& mesh, const MultiVector& columns, Vector& x) {
  const auto from = columns.getLocalViewHost(read_only);
  const auto to = x.getLocalViewHost(overwrite_all);
  for (int a = 0; a < mesh.n_owned; ++a)
    for (int i = 0; i < 3; ++i) to(3 * a + i, 0) = from(a, i);
}

}  // namespace

HarmonicExtension::HarmonicExtension(const fields::FieldMesh& mesh, std::vector<char> is_given)
    : mesh_(&mesh), is_given_(std::move(is_given)) {
  const fields::NodeGraph graph = fields::make_node_graph(mesh);
  jacobian_ = assembly::laplacian(mesh, mesh.x, graph, is_given_);
  laplacian_ = assembly::laplacian(mesh, mesh.x, graph, std::vector<char>(mesh.n_nodes(), 0));
}

void HarmonicExtension::residual(const MultiVector& phi, MultiVector& F) const {
  laplacian_->apply(phi, F);
  const auto view = F.getLocalViewHost(read_write);
  for (int a = 0; a < mesh_->n_owned; ++a)
    for (std::size_t j = 0; j < view.extent(1); ++j)
      if (is_given_[a]) view(a, j) = 0.0;
}

MeshMotion::MeshMotion(const fields::FieldMesh& mesh)
    : extension_(mesh, nodes_of_surfaces(mesh)),
      space_(fields::nodal_space(mesh, {{"mesh displacement", 3}})) {}

Outcome MeshMotion::residual(const algebra::BlockVector& x, algebra::BlockVector& F) {
  const fields::FieldMesh& mesh = extension_.mesh();
  MultiVector columns(mesh.node_map, 3);
  extension_.residual(columns_of(mesh, x[0]), columns);
  assign_columns(mesh, columns, F[0]);
  return Outcome::success();
}

void MeshMotion::assemble_jacobian(const algebra::BlockVector&) {
  if (K_.space()) return;
  const fields::FieldMesh& mesh = extension_.mesh();
  fields::BlockOperator K(mesh, {{"mesh displacement", 3}});
  double* const to = K.begin_assembly();
  // A row holds at each neighbour the columns of all components: L stands in its own.
  const auto from = extension_.jacobian()->getLocalMatrixHost();
  for (int a = 0; a < mesh.n_owned; ++a) {
    const auto scalar = from.rowConst(a);
    for (int k = 0; k < scalar.length; ++k) {
      double* const entry = to + K.rows(0).start[a] + K.place(a, scalar.colidx(k));
      for (int i = 0; i < 3; ++i) entry[i * K.rows(0).length[a] + i] = scalar.value(k);
    }
  }
  K.end_assembly();
  K_ = K;
}

double MeshMotion::mass_norm(const algebra::BlockVector& dx) const {
  const fields::FieldMesh& mesh = extension_.mesh();
  const std::vector<Vec3> d = fields::ghosted_vectors(mesh, dx[0]);
  const assembly::ElementGeometry geometry(mesh, mesh.x);
  double sum = 0.0;
  for (std::size_t e = 0; e < mesh.tets.size(); ++e)
    if (mesh.is_owned[e])
      sum += kernels::squared_norm(geometry[e].volume, assembly::gather(d, mesh.tets[e]));
  return std::sqrt(global_sum(*mesh.comm, sum));
}

}  // namespace tunica::discretisation
