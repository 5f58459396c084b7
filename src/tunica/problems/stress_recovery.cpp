#include "tunica/problems/stress_recovery.hpp"

#include <algorithm>
#include <cmath>

#include "tunica/assembly/gather.hpp"
#include "tunica/base/reduce.hpp"
#include "tunica/kernels/deformation.hpp"
#include "tunica/kernels/wall_stress.hpp"

namespace tunica::problems {

namespace {

constexpr int families = 2;

/// The layer of each region, the same on all ranks; -1 outside the wall.
std::vector<int> layers_of_regions(const SolidProblem& wall) {
  const fields::FieldMesh& mesh = wall.mesh();
  std::vector<int> layers(mesh.regions.size(), -1);
  for (std::size_t e = 0; e < mesh.tets.size(); ++e)
    layers[mesh.region[e]] = wall.field().elements().layer_number[e];
  for (int& layer : layers) layer = static_cast<int>(global_max(*mesh.comm, double(layer)));
  return layers;
}

/// a ⊗ a / |a|².
Sym3 along(const Vec3& a) {
  const Vec3 u = unit(a);
  return {u[0] * u[0], u[1] * u[1], u[2] * u[2], u[0] * u[1], u[1] * u[2], u[2] * u[0]};
}

Sym3 tensor_at(const std::vector<double>& values, std::size_t row, int columns, int first = 0) {
  Sym3 found;
  std::copy_n(values.begin() + static_cast<std::ptrdiff_t>(row * columns + first), 6,
              found.begin());
  return found;
}

double product(const Sym3& a, const Sym3& b) {
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2] + 2.0 * (a[3] * b[3] + a[4] * b[4] + a[5] * b[5]);
}

/// Per local element: σ and, with frames, a ⊗ a/|a|² of each family.
std::vector<double> elementwise(const SolidProblem& wall, int columns) {
  const fields::FieldMesh& mesh = wall.mesh();
  const assembly::SolidElements& elements = wall.field().elements();
  const auto d = fields::ghosted_vectors(mesh, wall.state()["displacement"]);
  const auto p = fields::ghosted_scalars(wall.scalar_mesh(), wall.state()["pressure"]);
  std::vector<double> values(columns * mesh.tets.size(), 0.0);
  for (std::size_t e = 0; e < mesh.tets.size(); ++e) {
    const kernels::Tet4 T = elements.geometry[e];
    const auto d_e = elements.displacement(e, assembly::gather(d, mesh.tets[e]));
    const materials::WallLaw& law = *elements.layer(e).law;
    const materials::Frame frame = elements.frame(e);
    const Sym3 sigma = kernels::cauchy_stress(
        T, d_e, assembly::gather(p, wall.scalar_mesh().tets[e]), law, frame, elements.past_of(e));
    auto at = values.begin() + static_cast<std::ptrdiff_t>(columns * e);
    at = std::copy(sigma.begin(), sigma.end(), at);
    if (columns == 6) continue;
    // f ⊗ f/|f|², f = F a of each family
    const std::vector<Vec3> fibres = law.fibre_directions(frame);
    for (std::size_t f = 0; f < std::min<std::size_t>(families, fibres.size()); ++f) {
      const Sym3 dyad = along(kernels::deformation_gradient(T, d_e) * fibres[f]);
      at = std::copy(dyad.begin(), dyad.end(), at);
    }
  }
  return values;
}

/// (1/V ∫ |Σ_a N_a D_a|² dV)^½ = (1/20 Σ_ab (1 + δ_ab) D_a : D_b)^½.
double mean_square_root(const std::array<Sym3, 4>& D) {
  double sum = 0.0;
  for (int a = 0; a < 4; ++a)
    for (int b = 0; b < 4; ++b) sum += (a == b ? 2.0 : 1.0) * product(D[a], D[b]);
  return std::sqrt(std::max(0.0, sum / 20.0));
}

}  // namespace

// Stress jumps between layers where pressures do not: patches end there all the same.
StressRecovery::StressRecovery(const SolidProblem& wall) : wall_(&wall) {
  if (wall.split() == nullptr)
    own_split_ = fields::split_mesh(wall.mesh(), layers_of_regions(wall));
  patches_ = std::make_unique<assembly::PatchRecovery>(
      own_split_ ? static_cast<const fields::FieldMesh&>(*own_split_) : wall.scalar_mesh());
}

NodalStress StressRecovery::recover() const {
  const bool has_fibres = !wall_->field().elements().frames.empty();
  const int columns = has_fibres ? 6 * (1 + families) : 6;
  const std::vector<double> of_elements = elementwise(*wall_, columns);
  const std::vector<double> at_nodes = patches_->at_nodes(columns, of_elements);
  NodalStress found;
  for (int a = 0; a < mesh().n_owned; ++a) {
    found.stress.push_back(tensor_at(at_nodes, a, columns));
    for (int f = 0; has_fibres && f < families; ++f) {
      // The mean of dyads has the mean direction for its first axis, whatever the signs of a.
      const auto axes = kernels::principal_axes(tensor_at(at_nodes, a, columns, 6 * (1 + f)));
      found.fibres[f].push_back(axes.values[0] > 0.0 ? axes.directions[0] : Vec3{});
    }
  }
  for (std::size_t e = 0; e < mesh().tets.size(); ++e) {
    const Sym3 sigma = tensor_at(of_elements, e, columns);
    // σ* − σ at the vertices, σ* linear in between
    std::array<Sym3, 4> difference;
    for (int a = 0; a < 4; ++a) {
      difference[a] = tensor_at(at_nodes, mesh().tets[e][a], columns);
      for (int k = 0; k < 6; ++k) difference[a][k] -= sigma[k];
    }
    found.error.push_back(mean_square_root(difference));
  }
  return found;
}

}  // namespace tunica::problems
