#include "tunica/assembly/block_assembler.hpp"

#include <algorithm>

#include "tunica/assembly/common_motion.hpp"
#include "tunica/base/error.hpp"

namespace tunica::assembly {

namespace {

/// The values of a matrix, zeroed and open for writing.
double* open_values(CrsMatrix& matrix) {
  matrix.resumeFill();
  const auto values = matrix.getLocalMatrixHost().values;
  std::fill(values.data(), values.data() + values.extent(0), 0.0);
  return values.data();
}

void close_values(CrsMatrix& matrix) {
  matrix.fillComplete(matrix.getDomainMap(), matrix.getRangeMap());
}

/// Zeroes constrained rows and columns of an element matrix but for their diagonals.
void constrain(const std::array<std::uint8_t, 4>& fixed, kernels::MixedJacobian& K) {
  for (int a = 0; a < 4; ++a)
    for (int b = 0; b < 4; ++b) {
      const bool is_fixed_p_row = fixed[a] & fixed_scalar, is_fixed_p_col = fixed[b] & fixed_scalar;
      for (int i = 0; i < 3; ++i) {
        const bool is_fixed_row = (fixed[a] >> i) & 1, is_fixed_col = (fixed[b] >> i) & 1;
        for (int j = 0; j < 3; ++j)
          if ((is_fixed_row || ((fixed[b] >> j) & 1)) && !(a == b && i == j)) K.A[a][b][i][j] = 0.0;
        if (is_fixed_row || is_fixed_p_col) K.B1T[a][b][i] = 0.0;
        if (is_fixed_p_row || is_fixed_col) K.B2[a][b][i] = 0.0;
      }
      if ((is_fixed_p_row || is_fixed_p_col) && a != b) K.mC[a][b] = 0.0;
    }
}

/// Copies what is not constrained.
void store_free(const std::vector<Vec3>& values, const Constraints& fixed, Vector& x) {
  const auto rows = x.getLocalViewHost(overwrite_all);
  for (std::size_t a = 0; a < values.size(); ++a)
    for (int i = 0; i < 3; ++i) rows(3 * a + i, 0) = (fixed[a] >> i) & 1 ? 0.0 : values[a][i];
}

}  // namespace

void NodalResidual::set_zero() {
  std::fill(u.begin(), u.end(), Vec3{});
  std::fill(p.begin(), p.end(), 0.0);
}

void NodalResidual::add(const fields::FieldMesh& mesh, std::size_t e,
                        const kernels::MixedResidual& R) {
  const auto& scalar_nodes = fields::scalar_mesh(mesh, split_).tets[e];
  for (int a = 0; a < 4; ++a) {
    const int node = mesh.tets[e][a];
    if (node >= mesh.n_owned) continue;
    u[node] += R.u[a];
    p[scalar_nodes[a]] += R.p[a];
  }
}

void NodalResidual::add(const fields::FieldMesh& mesh, const fields::Face& face,
                        const kernels::SurfaceResidual& R) {
  for (int a = 0; a < 3; ++a)
    if (face.nodes[a] < mesh.n_owned) u[face.nodes[a]] += R.u[a];
}

void NodalResidual::store(const fields::FieldMesh& mesh, const Constraints& fixed,
                          algebra::BlockVector& F) const {
  const auto fu = F[0].getLocalViewHost(overwrite_all);
  const auto fp = F[1].getLocalViewHost(overwrite_all);
  for (int a = 0; a < mesh.n_owned; ++a)
    for (int i = 0; i < 3; ++i) fu(3 * a + i, 0) = (fixed[a] >> i) & 1 ? 0.0 : u[a][i];
  for (std::size_t a = 0; a < p.size(); ++a)
    fp(a, 0) = fixed[fields::host_of(static_cast<int>(a), split_)] & fixed_scalar ? 0.0 : p[a];
}

BlockAssembler::BlockAssembler(fields::BlockOperator& K, const Constraints& fixed,
                               CommonMotions* motions)
    : K_(&K), mesh_(&K.mesh()), scalar_mesh_(&K.mesh_of(1)), fixed_(&fixed), motions_(motions),
      A_(open_values(*K(0, 0))), B1T_(open_values(*K(0, 1))), B2_(open_values(*K(1, 0))),
      mC_(open_values(*K(1, 1))) {
  if (motions_ != nullptr) motions_->begin();
}

void BlockAssembler::finish() {
  for (int i = 0; i < 2; ++i)
    for (int j = 0; j < 2; ++j) close_values(*(*K_)(i, j));
  if (motions_ != nullptr) motions_->store(*fixed_, *K_);
}

void BlockAssembler::add(std::size_t e, const kernels::MixedJacobian& Ke) {
  const auto& nodes = mesh_->tets[e];
  const std::array<std::uint8_t, 4> fixed{(*fixed_)[nodes[0]], (*fixed_)[nodes[1]],
                                          (*fixed_)[nodes[2]], (*fixed_)[nodes[3]]};
  if ((fixed[0] | fixed[1] | fixed[2] | fixed[3]) == 0) return scatter(e, Ke);
  if (motions_ != nullptr) motions_->collect(e, Ke);
  kernels::MixedJacobian constrained = Ke;
  constrain(fixed, constrained);
  scatter(e, constrained);
}

void BlockAssembler::add(double s, const std::vector<Vec3>& w, const std::vector<Vec3>& v) {
  TUNICA_ASSERT(K_->low_rank() && next_product_ < K_->low_rank()->rank(),
                "the terms add no more products than they announce");
  algebra::RankOne& product = (*K_->low_rank())[next_product_++];
  product.scale = s;
  store_free(w, *fixed_, product.w[0]);
  store_free(v, *fixed_, product.v[0]);
}

namespace {

/// A node's row of a graph, and where an element has its columns there.
struct Row {
  std::size_t start, length;
  const std::int16_t* position;

  Row(const fields::NodeGraph& graph, int node, std::size_t e, int a)
      : start(graph.row_start[node]), length(graph.row_start[node + 1] - start),
        position(graph.position[e].data() + 4 * a) {}
};

}  // namespace

void BlockAssembler::scatter(std::size_t e, const kernels::MixedJacobian& Ke) {
  const auto &nodes = mesh_->tets[e], &scalar_nodes = scalar_mesh_->tets[e];
  const bool is_split = K_->split() != nullptr;  // else all four graphs are one
  const fields::NodeGraph& graph = K_->graph(0, 0);
  for (int a = 0; a < 4; ++a) {
    if (nodes[a] >= mesh_->n_owned) continue;
    const Row uu(graph, nodes[a], e, a);
    const Row up = is_split ? Row(K_->graph(0, 1), nodes[a], e, a) : uu;
    const Row pu = is_split ? Row(K_->graph(1, 0), scalar_nodes[a], e, a) : uu;
    const Row pp = is_split ? Row(K_->graph(1, 1), scalar_nodes[a], e, a) : uu;
    for (int b = 0; b < 4; ++b) {
      double* A = A_ + 9 * uu.start + 3 * uu.position[b];
      double* B1T = B1T_ + 3 * up.start + up.position[b];
      double* B2 = B2_ + 3 * pu.start + 3 * pu.position[b];
      for (int i = 0; i < 3; ++i) {
        for (int j = 0; j < 3; ++j) A[3 * uu.length * i + j] += Ke.A[a][b][i][j];
        B1T[up.length * i] += Ke.B1T[a][b][i];
        B2[i] += Ke.B2[a][b][i];
      }
      mC_[pp.start + pp.position[b]] += Ke.mC[a][b];
    }
  }
}

void BlockAssembler::add(const fields::Face& face, const kernels::SurfaceJacobian& Ke) {
  if (motions_ != nullptr) motions_->collect(face, Ke);
  const fields::NodeGraph& graph = K_->graph(0, 0);
  for (int a = 0; a < 3; ++a) {
    const int row = face.nodes[a];
    if (row >= mesh_->n_owned) continue;
    const std::size_t start = graph.row_start[row];
    const std::size_t length = graph.row_start[row + 1] - start;
    const int* columns = graph.columns.data() + start;
    for (int b = 0; b < 3; ++b) {
      const int column = face.nodes[b];
      const std::size_t k = std::lower_bound(columns, columns + length, column) - columns;
      for (int i = 0; i < 3; ++i)
        for (int j = 0; j < 3; ++j) {
          const bool is_fixed = (((*fixed_)[row] >> i) | ((*fixed_)[column] >> j)) & 1;
          const bool is_diagonal = row == column && i == j;
          if (!is_fixed || is_diagonal)
            A_[9 * start + 3 * length * i + 3 * k + j] += Ke.A[a][b][i][j];
        }
    }
  }
}

}  // namespace tunica::assembly
