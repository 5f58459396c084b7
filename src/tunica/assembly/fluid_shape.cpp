#include "tunica/assembly/fluid_shape.hpp"

#include "tunica/assembly/gather.hpp"

namespace tunica::assembly {

FluidShapeMatrix::FluidShapeMatrix(const fields::FieldMesh& mesh, const fields::NodeGraph& graph)
    : mesh_(&mesh), graph_(&graph), u_(fields::make_matrix(graph, mesh, 3, 3)),
      p_(fields::make_matrix(graph, mesh, 1, 3)) {}

void FluidShapeMatrix::assemble(const FluidElements& elements, const FluidFields& state,
                                const std::vector<Vec3>& velocity, const Constraints& fixed) {
  const fields::FieldMesh& mesh = *mesh_;
  for (CrsMatrix* matrix : {u_.get(), p_.get()}) {
    matrix->resumeFill();
    matrix->setAllToScalar(0.0);
  }
  kernels::ShapeJacobian Ke;
  for (std::size_t e = 0; e < mesh.tets.size(); ++e) {
    const kernels::Tet4& T = elements.geometry[e];
    Vec3 c{};
    for (const int a : mesh.tets[e]) c += 0.25 * (velocity[a] - state.w[a]);
    kernels::fluid_up_shape_jacobian(
        T, state_of(state, mesh, e), elements.coefficients, elements.tau[e],
        kernels::fluid_tau_derivative(T, c, elements.coefficients), Ke);
    add(e, Ke, fixed);
  }
  for (CrsMatrix* matrix : {u_.get(), p_.get()})
    matrix->fillComplete(matrix->getDomainMap(), matrix->getRangeMap());
}

void FluidShapeMatrix::add(std::size_t e, const kernels::ShapeJacobian& Ke,
                           const Constraints& fixed) {
  const auto u = u_->getLocalMatrixHost().values, p = p_->getLocalMatrixHost().values;
  for (int a = 0; a < 4; ++a) {
    const int node = mesh_->tets[e][a];
    if (node >= mesh_->n_owned) continue;
    const std::size_t start = graph_->row_start[node], length = graph_->length(node);
    for (int b = 0; b < 4; ++b) {
      const std::size_t column = 3 * graph_->position[e][4 * a + b];
      for (int j = 0; j < 3; ++j) {
        const auto& k = Ke.u[a][b];
        const Vec3 free = fixed.project(node, {k[0][j], k[1][j], k[2][j]});
        for (int i = 0; i < 3; ++i) u(9 * start + 3 * length * i + column + j) += free[i];
        if (!fixed.is_scalar_fixed(node)) p(3 * start + column + j) += Ke.p[a][b][j];
      }
    }
  }
}

void FluidShapeMatrix::add(const Vector& d, algebra::BlockVector& F) const {
  u_->apply(d, F[0], Teuchos::NO_TRANS, 1.0, 1.0);
  p_->apply(d, F[1], Teuchos::NO_TRANS, 1.0, 1.0);
}

}  // namespace tunica::assembly
