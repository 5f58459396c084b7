#include "tunica/assembly/common_motion.hpp"

#include <algorithm>

#include "tunica/base/error.hpp"
#include "tunica/base/reduce.hpp"

namespace tunica::assembly {

CommonMotions::CommonMotions(const fields::FieldMesh& mesh, const fields::SplitMesh* split)
    : mesh_(&mesh), scalar_mesh_(&fields::scalar_mesh(mesh, split)), split_(split),
      motion_of_(3 * static_cast<std::size_t>(mesh.n_nodes()), -1), is_touched_(mesh.n_nodes(), 0) {
}

// Members are fixed as prescribed components are, so that elements leave their rows and columns
// out. What is left out is collected, and comes back as two products of vectors per motion.
int CommonMotions::add(int component, bool has_force, const std::vector<char>& members,
                       Constraints& fixed) {
  const int number = static_cast<int>(motions_.size());
  double mine = 0.0;
  bool is_alone = true, is_along_axes = true;
  for (int a = 0; a < mesh_->n_nodes(); ++a) {
    if (members[a] && motion_of(a, component) >= 0) is_alone = false;
    if (!members[a] || fixed.is_fixed(a, component)) continue;
    if (fixed.oblique(a) != nullptr) is_along_axes = false;
    fixed.fix_component(a, component);
    motion_of_[3 * a + component] = number;
    is_touched_[a] = 1;
    if (a < mesh_->n_owned) mine += 1.0;
  }
  TUNICA_CHECK(
      all_agree(*mesh_->comm, is_alone),
      "a surface that moves as one along " + std::string(1, "xyz"[component]) +
          " shares nodes with another one that does. Name that component for one of them.");
  TUNICA_CHECK(all_agree(*mesh_->comm, is_along_axes),
               "a surface that moves as one along " + std::string(1, "xyz"[component]) +
                   " shares nodes with one that is held along a normal across the axes. Hold that "
                   "one by components, or clamp it.");
  const Values zero{std::vector<Vec3>(mesh_->n_owned), std::vector<double>(scalar_mesh_->n_owned)};
  motions_.push_back({component, has_force, global_sum(*mesh_->comm, mine), zero, zero});
  return static_cast<int>(motions_.back().count);
}

// F_a = (Σ_b R_b − P)/n where P is given,   F_a = k/n (Σ_b u_b/n − ū) where ū is, k = 1 mN/mm
void CommonMotions::store(const NodalResidual& R, const std::vector<Vec3>& u,
                          const std::vector<double>& values, algebra::BlockVector& F) const {
  if (is_empty()) return;
  std::vector<double> sums(motions_.size(), 0.0);
  for (int a = 0; a < mesh_->n_owned; ++a)
    for (int i = 0; i < 3; ++i) {
      const int m = motion_of(a, i);
      if (m >= 0) sums[m] += motions_[m].has_force ? R.u[a][i] : u[a][i];
    }
  sums = global_sum(*mesh_->comm, sums);
  const auto rows = F[0].getLocalViewHost(read_write);
  for (int a = 0; a < mesh_->n_owned; ++a)
    for (int i = 0; i < 3; ++i) {
      const int m = motion_of(a, i);
      if (m < 0) continue;
      const double n = motions_[m].count;
      rows(3 * a + i, 0) = ((motions_[m].has_force ? sums[m] : sums[m] / n) - values[m]) / n;
    }
}

// q = Σ_a u_a/n
std::vector<double> CommonMotions::means(const Vector& u) const {
  if (is_empty()) return {};
  std::vector<double> sums(motions_.size(), 0.0);
  const auto values = u.getLocalViewHost(read_only);
  for (int row = 0; row < 3 * mesh_->n_owned; ++row)
    if (motion_of_[row] >= 0) sums[motion_of_[row]] += values(row, 0);
  sums = global_sum(*mesh_->comm, sums);
  for (std::size_t m = 0; m < sums.size(); ++m) sums[m] /= motions_[m].count;
  return sums;
}

// u_a ← q for the members a
void CommonMotions::insert(const std::vector<double>& values, Vector& u) const {
  if (is_empty()) return;
  const auto rows = u.getLocalViewHost(read_write);
  for (int row = 0; row < 3 * mesh_->n_owned; ++row)
    if (motion_of_[row] >= 0) rows(row, 0) = values[motion_of_[row]];
}

// K e and Kᵀ e are summed anew for each Jacobian.
void CommonMotions::begin() {
  for (Motion& motion : motions_)
    for (Values* each : {&motion.column, &motion.row}) {
      std::fill(each->u.begin(), each->u.end(), Vec3{});
      std::fill(each->p.begin(), each->p.end(), 0.0);
    }
}

// (K e)_a += K_ab for members b,   (Kᵀ e)_b += K_ab for members a
template <class Jacobian, class Nodes>
void CommonMotions::collect_vectors(const Nodes& nodes, const Jacobian& K) {
  const int n = static_cast<int>(nodes.size());
  for (int a = 0; a < n; ++a)
    for (int b = 0; b < n; ++b)
      for (int i = 0; i < 3; ++i)
        for (int j = 0; j < 3; ++j) {
          const int from = motion_of(nodes[b], j), to = motion_of(nodes[a], i);
          if (from >= 0 && nodes[a] < mesh_->n_owned)
            motions_[from].column.u[nodes[a]][i] += K.A[a][b][i][j];
          if (to >= 0 && nodes[b] < mesh_->n_owned)
            motions_[to].row.u[nodes[b]][j] += K.A[a][b][i][j];
        }
}

void CommonMotions::collect(std::size_t e, const kernels::MixedJacobian& K) {
  const auto &nodes = mesh_->tets[e], &scalar_nodes = scalar_mesh_->tets[e];
  if (std::none_of(nodes.begin(), nodes.end(), [this](int a) { return is_touched_[a]; })) return;
  collect_vectors(nodes, K);
  // Pressures of K e from B2, those of Kᵀ e from B1ᵀ. C couples no member.
  for (int a = 0; a < 4; ++a)
    for (int b = 0; b < 4; ++b)
      for (int i = 0; i < 3; ++i) {
        const int from = motion_of(nodes[b], i), to = motion_of(nodes[a], i);
        if (from >= 0 && nodes[a] < mesh_->n_owned)
          motions_[from].column.p[scalar_nodes[a]] += K.B2[a][b][i];
        if (to >= 0 && nodes[b] < mesh_->n_owned)
          motions_[to].row.p[scalar_nodes[b]] += K.B1T[a][b][i];
      }
}

void CommonMotions::collect(const fields::Face& face, const kernels::SurfaceJacobian& K) {
  if (!is_empty()) collect_vectors(face.nodes, K);
}

// e_lᵀ K e_m of all motions l, m
std::vector<double> CommonMotions::pair_sums() const {
  const std::size_t count = motions_.size();
  std::vector<double> mine(count * count, 0.0);
  for (int a = 0; a < mesh_->n_owned; ++a)
    for (int i = 0; i < 3; ++i) {
      const int row = motion_of(a, i);
      if (row < 0) continue;
      for (std::size_t m = 0; m < count; ++m) mine[row * count + m] += motions_[m].column.u[a][i];
    }
  return global_sum(*mesh_->comm, mine);
}

// w vᵀ = [K_ff e; −d_a] (e/n)ᵀ. On its members it takes d_a (mean y) from d_a y_a; members of other
// motions are projected out here, as r of the second product has them.
void CommonMotions::store_first(int m, const Constraints& fixed, const Vector& diagonal,
                                algebra::RankOne& product) const {
  const Values& column = motions_[m].column;
  product.scale = 1.0;
  const auto w = product.w[0].getLocalViewHost(overwrite_all);
  const auto v = product.v[0].getLocalViewHost(overwrite_all);
  const auto d = diagonal.getLocalViewHost(read_only);
  for (int a = 0; a < mesh_->n_owned; ++a)
    for (int i = 0; i < 3; ++i) {
      const bool is_member = motion_of(a, i) == m;
      w(3 * a + i, 0) = is_member ? -d(3 * a + i, 0) : fixed.project(a, column.u[a])[i];
      v(3 * a + i, 0) = is_member ? 1.0 / motions_[m].count : 0.0;
    }
  const auto w_p = product.w[1].getLocalViewHost(overwrite_all);
  for (int a = 0; a < scalar_mesh_->n_owned; ++a)
    w_p(a, 0) = is_fixed_scalar(a, fixed) ? 0.0 : column.p[a];
  product.v[1].putScalar(0.0);
}

// w vᵀ = [0; e/n] rᵀ with r = K_fᵀ e on free unknowns and e_mᵀ K e_l/n_l on the members of each
// motion l; r = e/n where ū is given
void CommonMotions::store_second(int m, const Constraints& fixed,
                                 const std::vector<double>& products,
                                 algebra::RankOne& product) const {
  const Motion& motion = motions_[m];
  product.scale = 1.0;
  const auto w = product.w[0].getLocalViewHost(overwrite_all);
  const auto v = product.v[0].getLocalViewHost(overwrite_all);
  for (int a = 0; a < mesh_->n_owned; ++a)
    for (int i = 0; i < 3; ++i) {
      const int other = motion_of(a, i);
      w(3 * a + i, 0) = other == m ? 1.0 / motion.count : 0.0;
      double value = fixed.project(a, motion.row.u[a])[i];
      if (other >= 0) value = products[m * motions_.size() + other] / motions_[other].count;
      if (!motion.has_force) value = other == m ? 1.0 / motion.count : 0.0;
      v(3 * a + i, 0) = value;
    }
  product.w[1].putScalar(0.0);
  const auto v_p = product.v[1].getLocalViewHost(overwrite_all);
  for (int a = 0; a < scalar_mesh_->n_owned; ++a)
    v_p(a, 0) = !motion.has_force || is_fixed_scalar(a, fixed) ? 0.0 : motion.row.p[a];
}

// The products of surfaces stand first, then two for each motion.
void CommonMotions::store(const Constraints& fixed, const Vector& diagonal,
                          algebra::LowRank& products) const {
  if (is_empty()) return;
  const std::vector<double> all = pair_sums();
  int next = products.rank() - rank();
  for (int m = 0; m < static_cast<int>(motions_.size()); ++m) {
    store_first(m, fixed, diagonal, products[next++]);
    store_second(m, fixed, all, products[next++]);
  }
}

}  // namespace tunica::assembly
