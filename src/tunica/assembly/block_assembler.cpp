#include "tunica/assembly/block_assembler.hpp"

#include <algorithm>

#include "tunica/assembly/common_motion.hpp"
#include "tunica/base/error.hpp"

namespace tunica::assembly {

namespace {

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
    : BlockAssembler({&K, nullptr, nullptr}, K.mesh(), fixed, motions, K.low_rank().get(),
                     K.begin_assembly()) {}

BlockAssembler::BlockAssembler(const Whole& whole, const fields::FieldMesh& mesh,
                               const Constraints& fixed, CommonMotions* motions,
                               algebra::LowRank* products)
    : BlockAssembler(whole, mesh, fixed, motions, products,
                     whole.K->merged()->getLocalMatrixHost().values.data()) {}

BlockAssembler::BlockAssembler(const Whole& whole, const fields::FieldMesh& mesh,
                               const Constraints& fixed, CommonMotions* motions,
                               algebra::LowRank* products, double* values)
    : K_(whole.K), place_(whole.place), mesh_(&mesh), fixed_(&fixed), motions_(motions),
      products_(products), values_(values), units_{{1.0, 1.0}, {1.0, 1.0}} {
  if (whole.units != nullptr)
    for (int i = 0; i < 2; ++i)
      for (int j = 0; j < 2; ++j)
        units_[i][j] = whole.units->unit_of_equations(i) * whole.units->unit_of_unknowns(j);
  if (motions_ != nullptr) motions_->begin();
}

void BlockAssembler::finish() {
  if (motions_ != nullptr) motions_->store(*fixed_, diagonal(), *products_);
  if (place_ == nullptr) K_->end_assembly();
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
  TUNICA_ASSERT(products_ != nullptr && next_product_ < products_->rank(),
                "the terms add no more products than they announce");
  algebra::RankOne& product = (*products_)[next_product_++];
  product.scale = s;
  store_free(w, *fixed_, product.w[0]);
  store_free(v, *fixed_, product.v[0]);
}

void BlockAssembler::scatter(std::size_t e, const kernels::MixedJacobian& Ke) {
  const std::size_t t = place_ != nullptr ? place_->tets[e] : e;
  const auto &nodes = K_->mesh().tets[t], &scalar_nodes = K_->mesh_of(1).tets[t];
  const auto uu = K_->places(t, 0, 0), up = K_->places(t, 0, 1), pu = K_->places(t, 1, 0),
             pp = K_->places(t, 1, 1);
  for (int a = 0; a < 4; ++a) {
    if (nodes[a] >= K_->mesh().n_owned) continue;
    double* const row_u = values_ + K_->rows(0).start[nodes[a]];
    double* const row_p = values_ + K_->rows(1).start[scalar_nodes[a]];
    const std::size_t length = K_->rows(0).length[nodes[a]];
    for (int b = 0; b < 4; ++b) {
      double* const A = row_u + uu(a, b);
      double* const B1T = row_u + up(a, b);
      double* const B2 = row_p + pu(a, b);
      for (int i = 0; i < 3; ++i) {
        for (int j = 0; j < 3; ++j) A[length * i + j] += units_[0][0] * Ke.A[a][b][i][j];
        B1T[length * i] += units_[0][1] * Ke.B1T[a][b][i];
        B2[i] += units_[1][0] * Ke.B2[a][b][i];
      }
      row_p[pp(a, b)] += units_[1][1] * Ke.mC[a][b];
    }
  }
}

void BlockAssembler::add(const fields::Face& face, const kernels::SurfaceJacobian& Ke) {
  if (motions_ != nullptr) motions_->collect(face, Ke);
  for (int a = 0; a < 3; ++a) {
    const int row = node_of(face.nodes[a]);
    if (row >= K_->mesh().n_owned) continue;
    const std::size_t length = K_->rows(0).length[row];
    for (int b = 0; b < 3; ++b) {
      double* const A = values_ + K_->rows(0).start[row] + K_->place(row, node_of(face.nodes[b]));
      for (int i = 0; i < 3; ++i)
        for (int j = 0; j < 3; ++j) {
          const bool is_fixed =
              (((*fixed_)[face.nodes[a]] >> i) | ((*fixed_)[face.nodes[b]] >> j)) & 1;
          const bool is_diagonal = a == b && i == j;
          if (!is_fixed || is_diagonal) A[length * i + j] += units_[0][0] * Ke.A[a][b][i][j];
        }
    }
  }
}

Vector BlockAssembler::diagonal() const {
  Vector diagonal(mesh_->vector_map);
  const auto d = diagonal.getLocalViewHost(overwrite_all);
  for (int a = 0; a < mesh_->n_owned; ++a) {
    const int node = node_of(a);
    const double* const A = values_ + K_->rows(0).start[node] + K_->place(node, node);
    for (int i = 0; i < 3; ++i)
      d(3 * a + i, 0) = A[K_->rows(0).length[node] * i + i] / units_[0][0];
  }
  return diagonal;
}

}  // namespace tunica::assembly
