#include "tunica/assembly/fluid_shape.hpp"

#include <algorithm>

#include "tunica/assembly/gather.hpp"
#include "tunica/kernels/fluid_tau.hpp"

namespace tunica::assembly {

// S = [∂F_u/∂x; ∂F_p/∂x], two matrices with three columns per node
FluidShapeMatrix::FluidShapeMatrix(const fields::FieldMesh& mesh, const fields::NodeGraph& graph,
                                   const Constraints& fixed)
    : mesh_(&mesh), graph_(&graph), fixed_(&fixed), u_(fields::make_matrix(graph, mesh, 3, 3)),
      p_(fields::make_matrix(graph, mesh, 1, 3)) {}

void FluidShapeMatrix::begin(const FluidElements& elements, const FluidFields& state,
                             const std::vector<Vec3>& velocity) {
  const fields::FieldMesh& mesh = *mesh_;
  products_.clear();
  for (CrsMatrix* matrix : {u_.get(), p_.get()}) {
    matrix->resumeFill();
    matrix->setAllToScalar(0.0);
  }
  // ∂R_e/∂x_b with ∂τ/∂x_b: τ follows h and c = u* − w of the element
  kernels::ShapeJacobian Ke;
  for (std::size_t e = 0; e < mesh.tets.size(); ++e) {
    const kernels::Tet4 T = elements.geometry[e];
    Vec3 c{};
    for (const int a : mesh.tets[e]) c += 0.25 * (velocity[a] - state.w[a]);
    kernels::fluid_up_shape_jacobian(
        T, state_of(state, mesh, e), elements.coefficients, elements.tau[e],
        kernels::fluid_tau_derivative(T, c, elements.viscosity[e], elements.coefficients), Ke);
    add(e, Ke);
  }
}

void FluidShapeMatrix::finish() {
  for (CrsMatrix* matrix : {u_.get(), p_.get()})
    matrix->fillComplete(matrix->getDomainMap(), matrix->getRangeMap());
}

// ∂R_a/∂x_b ← P_a k
void FluidShapeMatrix::add(const Values& u, int a, std::size_t column_of_b,
                           const double (&k)[3][3]) const {
  const std::size_t first = 9 * graph_->row_start[a] + 3 * column_of_b;
  for (int j = 0; j < 3; ++j) {
    const Vec3 free = fixed_->project(a, {k[0][j], k[1][j], k[2][j]});
    for (int i = 0; i < 3; ++i) u(first + 3 * graph_->length(a) * i + j) += free[i];
  }
}

void FluidShapeMatrix::add(std::size_t e, const kernels::ShapeJacobian& Ke) {
  // Rows P_a ∂R_a/∂x_b; a fixed pressure has no equation. Columns keep all directions: the mesh
  // moves where the fluid is held, too.
  const auto u = u_->getLocalMatrixHost().values, p = p_->getLocalMatrixHost().values;
  for (int a = 0; a < 4; ++a) {
    const int node = mesh_->tets[e][a];
    if (node >= mesh_->n_owned) continue;
    for (int b = 0; b < 4; ++b) {
      const std::size_t column = graph_->position[e][4 * a + b];
      add(u, node, column, Ke.u[a][b]);
      if (fixed_->is_scalar_fixed(node)) continue;
      for (int j = 0; j < 3; ++j) p(3 * (graph_->row_start[node] + column) + j) += Ke.p[a][b][j];
    }
  }
}

void FluidShapeMatrix::add(const fields::Face& face, const kernels::SurfaceJacobian& Ke) {
  const auto u = u_->getLocalMatrixHost().values;
  for (int a = 0; a < 3; ++a) {
    const int node = face.nodes[a];
    if (node >= mesh_->n_owned) continue;
    // Columns of a row ascend: bisection finds those of a face, which has no table of places.
    const auto first =
        graph_->columns.begin() + static_cast<std::ptrdiff_t>(graph_->row_start[node]);
    const auto last = first + static_cast<std::ptrdiff_t>(graph_->length(node));
    for (int b = 0; b < 3; ++b) {
      const auto found = std::lower_bound(first, last, face.nodes[b]);
      add(u, node, static_cast<std::size_t>(found - first), Ke.A[a][b]);
    }
  }
}

void FluidShapeMatrix::add(double s, const std::vector<Vec3>& w, const std::vector<Vec3>& v) {
  // s (P w) vᵀ
  Product& product =
      products_.emplace_back(Product{s, Vector(mesh_->vector_map), Vector(mesh_->vector_map)});
  const auto rows = product.w.getLocalViewHost(overwrite_all);
  const auto columns = product.v.getLocalViewHost(overwrite_all);
  for (int a = 0; a < mesh_->n_owned; ++a) {
    const Vec3 free = fixed_->project(a, w[a]);
    for (int i = 0; i < 3; ++i) {
      rows(3 * a + i, 0) = free[i];
      columns(3 * a + i, 0) = v[a][i];
    }
  }
}

// F_u ← F_u + S_u d + Σ s w (vᵀ d),   F_p ← F_p + S_p d
void FluidShapeMatrix::add_product(const Vector& d, algebra::BlockVector& F) const {
  u_->apply(d, F[0], Teuchos::NO_TRANS, 1.0, 1.0);
  p_->apply(d, F[1], Teuchos::NO_TRANS, 1.0, 1.0);
  for (const Product& product : products_)
    F[0].update(product.scale * product.v.dot(d), product.w, 1.0);
}

}  // namespace tunica::assembly
