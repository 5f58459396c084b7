#include "tunica/assembly/block_assembler.hpp"

#include <algorithm>

#include "tunica/assembly/common_motion.hpp"
#include "tunica/base/error.hpp"

namespace tunica::assembly {

namespace {

// What is prescribed is taken out of rows and columns alike, in the matrix of each element. With
// the projectors P_a of its nodes
//
//   k_ab ← P_a k_ab P_b + δ_ab s_a (I − P_a),   s_a  mean of k_aa along what P_a leaves out
//
// Summed over elements, what is left on the diagonal has the size of its neighbours. The state has
// the prescribed values before Newton's method begins, and increments are zero there: the columns
// that are dropped need no right side.

/// Rows and columns of unknown i at node a become zero but for their diagonal.
template <std::size_t n, std::size_t m>
void leave_out(int a, int i, double (&k)[n][n][m][m]) {
  const double diagonal = k[a][a][i][i];
  for (std::size_t b = 0; b < n; ++b)
    for (std::size_t j = 0; j < m; ++j) k[a][b][i][j] = k[b][a][j][i] = 0.0;
  k[a][a][i][i] = diagonal;
}

/// The same across the axes: k ← P k P + s N, N = I − P, s the mean of k's diagonal along N.
template <std::size_t n, std::size_t m>
void leave_out(int a, const Mat3& P, double (&k)[n][n][m][m]) {
  // s = tr(N k_aa)/tr N
  double trace = 0.0, rank = 3.0;
  for (int i = 0; i < 3; ++i) {
    rank -= P[i][i];
    for (int j = 0; j < 3; ++j) trace += ((i == j ? 1.0 : 0.0) - P[i][j]) * k[a][a][j][i];
  }
  for (std::size_t b = 0; b < n; ++b)
    for (std::size_t j = 0; j < m; ++j) {
      const Vec3 row = P * Vec3{k[a][b][0][j], k[a][b][1][j], k[a][b][2][j]};
      for (int i = 0; i < 3; ++i) k[a][b][i][j] = row[i];
    }
  for (std::size_t b = 0; b < n; ++b)
    for (std::size_t j = 0; j < m; ++j) {
      const Vec3 column = P * Vec3{k[b][a][j][0], k[b][a][j][1], k[b][a][j][2]};
      for (int i = 0; i < 3; ++i) k[b][a][j][i] = column[i];
    }
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j) k[a][a][i][j] += trace / rank * ((i == j ? 1.0 : 0.0) - P[i][j]);
}

/// Leaves out what is prescribed, in the matrix of an element or of a face; m = 4: with a scalar.
template <class Nodes, std::size_t n, std::size_t m>
void constrain(const Constraints& fixed, const Nodes& nodes, double (&k)[n][n][m][m]) {
  for (std::size_t a = 0; a < n; ++a) {
    if (fixed.is_free(nodes[a])) continue;
    if (const Mat3* const P = fixed.oblique(nodes[a])) {
      leave_out(a, *P, k);
    } else {
      for (int i = 0; i < 3; ++i)
        if (fixed.is_fixed(nodes[a], i)) leave_out(a, i, k);
    }
    if constexpr (m == 4)
      if (fixed.is_scalar_fixed(nodes[a])) leave_out(a, 3, k);
  }
}

template <class Nodes>
bool are_free(const Constraints& fixed, const Nodes& nodes) {
  return std::all_of(nodes.begin(), nodes.end(), [&](int a) { return fixed.is_free(a); });
}

/// Row i of a pair of nodes in all lanes into the elements' matrices.
inline void separate(const Pack (&row)[4], int a, int b, int i, ElementMatrix* K) {
  static_assert(Pack::size == 4);
  // A 4×4 transpose: lane l of the four entries is the row of element l.
  const auto &v0 = row[0].values(), &v1 = row[1].values(), &v2 = row[2].values(),
             &v3 = row[3].values();
  const auto even01 = __builtin_shufflevector(v0, v1, 0, 4, 2, 6);
  const auto odd01 = __builtin_shufflevector(v0, v1, 1, 5, 3, 7);
  const auto even23 = __builtin_shufflevector(v2, v3, 0, 4, 2, 6);
  const auto odd23 = __builtin_shufflevector(v2, v3, 1, 5, 3, 7);
  Pack(__builtin_shufflevector(even01, even23, 0, 1, 4, 5)).store(K[0].k[a][b][i]);
  Pack(__builtin_shufflevector(odd01, odd23, 0, 1, 4, 5)).store(K[1].k[a][b][i]);
  Pack(__builtin_shufflevector(even01, even23, 2, 3, 6, 7)).store(K[2].k[a][b][i]);
  Pack(__builtin_shufflevector(odd01, odd23, 2, 3, 6, 7)).store(K[3].k[a][b][i]);
}

/// A pack of Jacobians, times the units of their blocks, as those of its elements.
TUNICA_PACKED void separate(const kernels::MixedJacobianOf<Pack>& Ke, const double units[2][2],
                            ElementMatrix* K) {
  // k_ab = [uu A_ab, up B1ᵀ_ab; pu B2_ab, −pp C_ab], a row of four at a time
  const Pack uu = units[0][0], up = units[0][1], pu = units[1][0], pp = units[1][1];
  for (int a = 0; a < 4; ++a)
    for (int b = 0; b < 4; ++b) {
      for (int i = 0; i < 3; ++i) {
        const Pack* const A = Ke.A[a][b][i];
        separate({uu * A[0], uu * A[1], uu * A[2], up * Ke.B1T[a][b][i]}, a, b, i, K);
      }
      const Pack* const B2 = Ke.B2[a][b];
      separate({pu * B2[0], pu * B2[1], pu * B2[2], pp * Ke.mC[a][b]}, a, b, 3, K);
    }
}

inline void add_four(const double* from, double* to) {
  (Pack::load(to) + Pack::load(from)).store(to);
}

/// Adds where the unknowns of a node stand side by side: places[4a + b] is where those of b begin
/// in the rows of a.
TUNICA_CLONES void add_side_by_side(const ElementMatrix& Ke, const ElementRows& rows,
                                    const std::int16_t* places) {
  for (int a = 0; a < 4; ++a) {
    if (rows.vector[a] == nullptr) continue;
    for (int b = 0; b < 4; ++b) {
      double* const row = rows.vector[a] + places[4 * a + b];
      for (int i = 0; i < 3; ++i) add_four(Ke.k[a][b][i], row + i * rows.length[a]);
      add_four(Ke.k[a][b][3], rows.scalar[a] + places[4 * a + b]);
    }
  }
}

/// Adds where scalars may have places of their own, in the rows of a vector and of a scalar. Rows
/// of a scalar have no columns that those of its vector lack: what stands side by side in these
/// does so in those.
TUNICA_CLONES void add_apart(const ElementMatrix& Ke, const ElementRows& rows,
                             const fields::BlockOperator::Places (&of_vector)[2],
                             const fields::BlockOperator::Places (&of_scalar)[2]) {
  for (int b = 0; b < 4; ++b)
    for (int a = 0; a < 4; ++a) {
      if (rows.vector[a] == nullptr) continue;
      const auto& k = Ke.k[a][b];
      double* const row = rows.vector[a] + of_vector[0](a, b);
      double* const last = rows.scalar[a] + of_scalar[0](a, b);
      // A scalar that stands behind its vector in the rows makes rows of four again.
      const int apart = of_vector[1](a, b) - of_vector[0](a, b);
      if (apart == 3) {
        for (int i = 0; i < 3; ++i) add_four(k[i], row + i * rows.length[a]);
        add_four(k[3], last);
        continue;
      }
      for (int i = 0; i < 3; ++i) {
        for (int j = 0; j < 3; ++j) row[i * rows.length[a] + j] += k[i][j];
        row[i * rows.length[a] + apart] += k[i][3];
      }
      for (int j = 0; j < 3; ++j) last[j] += k[3][j];
      rows.scalar[a][of_scalar[1](a, b)] += k[3][3];
    }
}

kernels::MixedJacobian lane_of(const kernels::MixedJacobianOf<Pack>& Ke, int lane) {
  kernels::MixedJacobian K;
  for (int a = 0; a < 4; ++a)
    for (int b = 0; b < 4; ++b) {
      for (int i = 0; i < 3; ++i) {
        for (int j = 0; j < 3; ++j) K.A[a][b][i][j] = Ke.A[a][b][i][j][lane];
        K.B1T[a][b][i] = Ke.B1T[a][b][i][lane];
        K.B2[a][b][i] = Ke.B2[a][b][i][lane];
      }
      K.mC[a][b] = Ke.mC[a][b][lane];
    }
  return K;
}

/// Copies what is not constrained.
void store_free(const std::vector<Vec3>& values, const Constraints& fixed, Vector& x) {
  const auto rows = x.getLocalViewHost(overwrite_all);
  for (std::size_t a = 0; a < values.size(); ++a) {
    const Vec3 free = fixed.project(static_cast<int>(a), values[a]);
    for (int i = 0; i < 3; ++i) rows(3 * a + i, 0) = free[i];
  }
}

}  // namespace

void NodalResidual::set_zero() {
  std::fill(u.begin(), u.end(), Vec3{});
  std::fill(p.begin(), p.end(), 0.0);
}

// R_a ← R_a + Σ_e R_e,a. A ghost's row belongs to its owner, who has the element, too; lanes beyond
// the last element repeat it and do not count.
void NodalResidual::add(const fields::FieldMesh& mesh, const PackedElements& elements,
                        const kernels::MixedResidualOf<Pack>& R) {
  for (int lane = 0; lane < elements.n; ++lane) {
    const std::size_t e = elements.number[lane];
    const auto& scalar_nodes = fields::scalar_mesh(mesh, split_).tets[e];
    for (int a = 0; a < 4; ++a) {
      const int node = mesh.tets[e][a];
      if (node >= mesh.n_owned) continue;
      for (int i = 0; i < 3; ++i) u[node][i] += R.u[a][i][lane];
      p[scalar_nodes[a]] += R.p[a][lane];
    }
  }
}

void NodalResidual::add(const fields::FieldMesh& mesh, const fields::Face& face,
                        const kernels::SurfaceResidual& R) {
  for (int a = 0; a < 3; ++a)
    if (face.nodes[a] < mesh.n_owned) u[face.nodes[a]] += R.u[a];
}

// F_u = P R_u, F_p = R_p or zero. R itself keeps the reactions.
void NodalResidual::store(const Constraints& fixed, algebra::BlockVector& F) const {
  store_free(u, fixed, F[0]);
  const auto fp = F[1].getLocalViewHost(overwrite_all);
  for (std::size_t a = 0; a < p.size(); ++a)
    fp(a, 0) = fixed.is_scalar_fixed(fields::host_of(static_cast<int>(a), split_)) ? 0.0 : p[a];
}

// The field's own Jacobian: the same nodes and units, and zeros to begin with.
BlockAssembler::BlockAssembler(fields::BlockOperator& K, const Constraints& fixed,
                               CommonMotions* motions)
    : BlockAssembler({&K, nullptr, nullptr}, K.mesh(), fixed, motions, K.low_rank().get(),
                     K.begin_assembly()) {}

BlockAssembler::BlockAssembler(const Whole& whole, const fields::FieldMesh& mesh,
                               const Constraints& fixed, CommonMotions* motions,
                               algebra::LowRank* products)
    : BlockAssembler(whole, mesh, fixed, motions, products,
                     whole.K->merged()->getLocalMatrixHost().values.data()) {}

// Block (i, j) of the field in the whole has the unit R_i S_j, see algebra::Embedding.
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

// The motions come last, since they need the diagonal of all of K. A whole is closed by its owner.
void BlockAssembler::finish() {
  if (motions_ != nullptr) motions_->store(*fixed_, diagonal(), *products_);
  if (place_ == nullptr) K_->end_assembly();
}

void BlockAssembler::begin(const PackedElements& elements) {
  elements_ = elements;
  for (int lane = 0; lane < elements.n; ++lane) {
    const std::size_t tet = tet_of(elements.number[lane]);
    ElementRows& rows = rows_[lane];
    rows = rows_of(tet);
    // Side by side the columns of the scalar lie in the same lines of memory as the vector's.
    const int n_blocks = K_->places_side_by_side(tet) != nullptr ? 1 : 2;
    for (int block = 0; block < n_blocks; ++block) {
      const auto of_vector = K_->places(tet, 0, block), of_scalar = K_->places(tet, 1, block);
      for (int a = 0; a < 4; ++a) {
        if (rows.vector[a] == nullptr) continue;
        for (int b = 0; b < 4; ++b) {
          const double* const row = rows.vector[a] + of_vector(a, b);
          for (int i = 0; i < 3; ++i) __builtin_prefetch(row + i * rows.length[a], 1);
          __builtin_prefetch(rows.scalar[a] + of_scalar(a, b), 1);
        }
      }
    }
  }
}

void BlockAssembler::add(const kernels::MixedJacobianOf<Pack>& Ke) {
  TUNICA_ASSERT(elements_.n > 0, "begin() comes before each add()");
  ElementMatrix K[Pack::size];
  separate(Ke, units_, K);
  for (int lane = 0; lane < elements_.n; ++lane) {
    const std::size_t e = elements_.number[lane];
    // K_e ← P K_e P + s (I − P); motions get the rows and columns of members before these vanish.
    if (const auto& nodes = mesh_->tets[e]; !are_free(*fixed_, nodes)) {
      if (motions_ != nullptr) motions_->collect(e, lane_of(Ke, lane));
      constrain(*fixed_, nodes, K[lane].k);
    }
    scatter(tet_of(e), rows_[lane], K[lane]);
  }
  elements_.n = 0;
}

// s (P w)(P v)ᵀ: prescribed unknowns neither feel it nor add to it.
void BlockAssembler::add(double s, const std::vector<Vec3>& w, const std::vector<Vec3>& v) {
  TUNICA_ASSERT(products_ != nullptr && next_product_ < products_->rank(),
                "the terms add no more products than they announce");
  algebra::RankOne& product = (*products_)[next_product_++];
  product.scale = s;
  store_free(w, *fixed_, product.w[0]);
  store_free(v, *fixed_, product.v[0]);
}

// Row i of node a begins at start_a + i length_a; all its rows have the same columns.
ElementRows BlockAssembler::rows_of(std::size_t tet) const {
  const auto &nodes = K_->mesh().tets[tet], &scalar_nodes = K_->mesh_of(1).tets[tet];
  ElementRows rows;
  for (int a = 0; a < 4; ++a) {
    const bool is_owned = nodes[a] < K_->mesh().n_owned;
    rows.vector[a] = is_owned ? values_ + K_->rows(0).start[nodes[a]] : nullptr;
    rows.scalar[a] = is_owned ? values_ + K_->rows(1).start[scalar_nodes[a]] : nullptr;
    rows.length[a] = is_owned ? K_->rows(0).length[nodes[a]] : 0;
  }
  return rows;
}

void BlockAssembler::scatter(std::size_t tet, const ElementRows& rows, const ElementMatrix& Ke) {
  // Only elements where scalars jump have a table for each pair of blocks.
  if (const std::int16_t* const places = K_->places_side_by_side(tet))
    return add_side_by_side(Ke, rows, places);
  add_apart(Ke, rows, {K_->places(tet, 0, 0), K_->places(tet, 0, 1)},
            {K_->places(tet, 1, 0), K_->places(tet, 1, 1)});
}

// A ← A + k, constrained as elements are: loads of surfaces depend on the vector alone. Faces have
// no table of places, and look their columns up.
void BlockAssembler::add(const fields::Face& face, const kernels::SurfaceJacobian& Ke) {
  if (motions_ != nullptr) motions_->collect(face, Ke);
  kernels::SurfaceJacobian K = Ke;
  constrain(*fixed_, face.nodes, K.A);
  for (int a = 0; a < 3; ++a) {
    const int row = node_of(face.nodes[a]);
    if (row >= K_->mesh().n_owned) continue;
    const std::size_t length = K_->rows(0).length[row];
    for (int b = 0; b < 3; ++b) {
      double* const A = values_ + K_->rows(0).start[row] + K_->place(row, node_of(face.nodes[b]));
      for (int i = 0; i < 3; ++i)
        for (int j = 0; j < 3; ++j) A[length * i + j] += units_[0][0] * K.A[a][b][i][j];
    }
  }
}

// diag(A)/(R S), in units of the field as its products are
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
