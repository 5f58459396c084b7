#include "tunica/assembly/patch_recovery.hpp"

#include <algorithm>
#include <cmath>

#include "tunica/kernels/principal_axes.hpp"

namespace tunica::assembly {

namespace {

constexpr double most_deviations = 3.0;
constexpr int at_once = 2;  ///< components

Vec3 centroid(const fields::FieldMesh& mesh, std::size_t e) {
  Vec3 sum{};
  for (const int a : mesh.tets[e]) sum += mesh.x[a];
  return 0.25 * sum;
}

/// Sums over the elements around each node, so many numbers per node, on owned and ghost nodes.
/// Only those of owned nodes see all their elements.
std::vector<double> shared(const fields::FieldMesh& mesh, int columns,
                           const std::vector<double>& sums) {
  MultiVector owned(mesh.node_map, columns), all(mesh.ghosted_map, columns);
  {
    const auto view = owned.getLocalViewHost(overwrite_all);
    for (int a = 0; a < mesh.n_owned; ++a)
      for (int k = 0; k < columns; ++k) view(a, k) = sums[a * columns + k];
  }
  all.doImport(owned, *mesh.import, insert);
  std::vector<double> values(mesh.n_nodes() * static_cast<std::size_t>(columns));
  const auto view = all.getLocalViewHost(read_only);
  for (int a = 0; a < mesh.n_nodes(); ++a)
    for (int k = 0; k < columns; ++k) values[a * columns + k] = view(a, k);
  return values;
}

/// Calls add(a, b) for each element that has the owned node a and the node b: n_ab times.
template <class Add>
void for_neighbours(const fields::FieldMesh& mesh, const Add& add) {
  for (const std::array<int, 4>& tet : mesh.tets)
    for (const int a : tet)
      if (a < mesh.n_owned)
        for (const int b : tet) add(a, b);
}

/// Σw, Σw y and Σw y yᵀ of the centroids, y from the node.
struct Moments {
  static constexpr int size = 10;
  double count = 0.0;
  Vec3 first{};
  Sym3 second{};

  // About another node y ← y + s:   Σw (y + s)(y + s)ᵀ = M₂ + m₁ sᵀ + s m₁ᵀ + M₀ s sᵀ
  void add(const Moments& other, const Vec3& shift) {
    const Vec3& f = other.first;
    count += other.count;
    first += f + other.count * shift;
    for (int k = 0; k < 6; ++k) {
      const auto [i, j] = pairs[k];
      second[k] +=
          other.second[k] + f[i] * shift[j] + shift[i] * f[j] + other.count * shift[i] * shift[j];
    }
  }
  static constexpr std::array<std::array<int, 2>, 6> pairs{
      {{0, 0}, {1, 1}, {2, 2}, {0, 1}, {1, 2}, {2, 0}}};
};

/// Of the elements around each node, on owned and ghost nodes.
std::vector<Moments> moments_around(const fields::FieldMesh& mesh) {
  // y = x_e − x_a, each element with the weight 1 at each of its vertices; owners have all of
  // theirs
  std::vector<Moments> moments(mesh.n_nodes());
  for (std::size_t e = 0; e < mesh.tets.size(); ++e) {
    Moments one;
    one.count = 1.0;
    const Vec3 c = centroid(mesh, e);
    for (const int a : mesh.tets[e]) moments[a].add(one, c - mesh.x[a]);
  }
  std::vector<double> rows;
  for (const Moments& m : moments) {
    rows.push_back(m.count);
    rows.insert(rows.end(), m.first.begin(), m.first.end());
    rows.insert(rows.end(), m.second.begin(), m.second.end());
  }
  rows = shared(mesh, Moments::size, rows);
  for (std::size_t a = 0; a < moments.size(); ++a) {
    const double* row = &rows[a * Moments::size];
    moments[a].count = row[0];
    std::copy(row + 1, row + 4, moments[a].first.begin());
    std::copy(row + 4, row + 10, moments[a].second.begin());
  }
  return moments;
}

/// β = C⁺(x_a − x̄), limited, for the patch's moments about the node: v(x_a) = v̄ + β·cov(x, v).
Vec3 slope_weight(const Moments& patch) {
  const Vec3 mean = 1.0 / patch.count * patch.first;
  Sym3 C;
  for (int k = 0; k < 6; ++k)
    C[k] = patch.second[k] / patch.count - mean[Moments::pairs[k][0]] * mean[Moments::pairs[k][1]];
  const kernels::PrincipalAxes axes = kernels::principal_axes(C);
  Vec3 beta{};
  for (int k = 0; k < 3; ++k) {
    const double d = -dot(axes.directions[k], mean), lambda = axes.values[k];
    // Where all centroids lie in a plane nothing is known across it: no slope there.
    if (!(lambda > 1e-14 * axes.values[0])) continue;
    const double limit = most_deviations * std::sqrt(lambda);
    beta += std::clamp(d, -limit, limit) / lambda * axes.directions[k];
  }
  return beta;
}

}  // namespace

// The moments of a patch are those around its vertices, shifted to the node and summed n_ab times:
//
//   M_a = Σ_b n_ab (M_b about x_a),   hence element e counts w_e = Σ_{b∈e} n_ab
PatchRecovery::PatchRecovery(const fields::FieldMesh& mesh) : mesh_(&mesh) {
  const std::vector<Moments> around = moments_around(mesh);
  std::vector<Moments> patches(mesh.n_owned);
  for_neighbours(mesh, [&](int a, int b) { patches[a].add(around[b], mesh.x[b] - mesh.x[a]); });
  for (const Moments& patch : patches) {
    // v̄ + β·cov(y, v) = Σ w (1 + β·(y − ȳ)) v / Σ w
    const Vec3 beta = slope_weight(patch);
    constant_.push_back((1.0 - dot(beta, patch.first) / patch.count) / patch.count);
    slope_.push_back(1.0 / patch.count * beta);
  }
}

// Some at a time: with Σ y v they take four times the room of the result, at owned nodes and
// neighbours.
std::vector<double> PatchRecovery::at_owned_nodes(int components,
                                                  const std::vector<double>& values) const {
  std::vector<double> nodal(mesh_->n_owned * static_cast<std::size_t>(components), 0.0);
  for (int first = 0; first < components; first += at_once)
    add_at_owned_nodes(components, first, std::min(first + at_once, components), values, nodal);
  return nodal;
}

void PatchRecovery::add_at_owned_nodes(int components, int first, int last,
                                       const std::vector<double>& values,
                                       std::vector<double>& nodal) const {
  const fields::FieldMesh& mesh = *mesh_;
  const int columns = 4 * (last - first);  // Σ v and Σ y v
  // v*_a = Σ_b Σ_{e∋b} (c_a + β_a·(x_b − x_a + y_e)) v_e, y_e of its centroid from x_b: with Σ v
  // and Σ y v around each b, which ranks share, none needs the second ring of elements.
  std::vector<double> sums(mesh.n_nodes() * static_cast<std::size_t>(columns), 0.0);
  for (std::size_t e = 0; e < mesh.tets.size(); ++e) {
    const Vec3 c = centroid(mesh, e);
    for (const int a : mesh.tets[e]) {
      const Vec3 y = c - mesh.x[a];
      for (int k = first; k < last; ++k) {
        const double v = values[e * components + k];
        double* sum = &sums[a * static_cast<std::size_t>(columns) + 4 * (k - first)];
        sum[0] += v;
        for (int i = 0; i < 3; ++i) sum[1 + i] += y[i] * v;
      }
    }
  }
  sums = shared(mesh, columns, sums);
  for_neighbours(mesh, [&](int a, int b) {
    const Vec3& beta = slope_[a];
    const double weight = constant_[a] + dot(beta, mesh.x[b] - mesh.x[a]);
    for (int k = first; k < last; ++k) {
      const double* sum = &sums[b * static_cast<std::size_t>(columns) + 4 * (k - first)];
      nodal[a * static_cast<std::size_t>(components) + k] +=
          weight * sum[0] + beta[0] * sum[1] + beta[1] * sum[2] + beta[2] * sum[3];
    }
  });
}

std::vector<double> PatchRecovery::at_nodes(int components,
                                            const std::vector<double>& values) const {
  // Ghosts get the values of their owners, whose patches are whole.
  std::vector<double> nodal = at_owned_nodes(components, values);
  nodal.resize(mesh_->n_nodes() * static_cast<std::size_t>(components));
  return shared(*mesh_, components, nodal);
}

}  // namespace tunica::assembly
