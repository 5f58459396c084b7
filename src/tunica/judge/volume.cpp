#include "tunica/judge/volume.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "tunica/assembly/gather.hpp"
#include "tunica/base/formatted.hpp"
#include "tunica/base/reduce.hpp"
#include "tunica/judge/place_of_least.hpp"
#include "tunica/judge/stiffness.hpp"
#include "tunica/kernels/solid_up.hpp"

namespace tunica::judge {

namespace {

constexpr double lowest = 0.9, highest = 1.1;  ///< usual

/// The value that a part of all ranks' values lies below, to 1e-4, by halves.
double quantile(const Comm& comm, const std::vector<double>& mine, double part, double low,
                double high) {
  const double wanted = part * global_sum(comm, double(mine.size()));
  while (high - low > 1e-4) {
    const double middle = 0.5 * (low + high);
    const auto below =
        std::count_if(mine.begin(), mine.end(), [&](double v) { return v < middle; });
    (global_sum(comm, double(below)) < wanted ? low : high) = middle;
  }
  return 0.5 * (low + high);
}

/// Of the elements of a layer that are counted on any rank.
struct Elements {
  std::vector<double> J;
  std::vector<char> is_at_edge;
  Vec3 place{};                                            ///< of the worst
  double worst = std::numeric_limits<double>::infinity();  ///< −|ln J|
};

/// Σ V₀ J and Σ V₀ about each node.
struct Means {
  std::vector<double> now, before;

  explicit Means(int n_nodes) : now(n_nodes), before(n_nodes) {}
  void add(const std::array<int, 4>& nodes, double V, double J) {
    for (const int a : nodes) {
      now[a] += V * J;
      before[a] += V;
    }
  }
};

/// Owned nodes know all of their elements.
void measure_means(const Means& means, const fields::FieldMesh& mesh,
                   const std::vector<char>& is_at_edge, LayerVolume& volume) {
  for (int a = 0; a < mesh.n_owned; ++a) {
    if (means.before[a] == 0.0 || is_at_edge[a] != 0) continue;
    volume.least_mean = std::min(volume.least_mean, means.now[a] / means.before[a]);
    volume.most_mean = std::max(volume.most_mean, means.now[a] / means.before[a]);
  }
  volume.least_mean = global_min(*mesh.comm, volume.least_mean);
  volume.most_mean = global_max(*mesh.comm, volume.most_mean);
}

void measure_elements(const Elements& all, const Comm& comm, LayerVolume& volume) {
  for (std::size_t i = 0; i < all.J.size(); ++i) {
    const double J = all.J[i];
    volume.least = std::min(volume.least, J);
    volume.largest = std::max(volume.largest, J);
    if (J >= lowest && J <= highest) continue;
    ++volume.beyond;
    if (all.is_at_edge[i]) ++volume.at_edges;
  }
  volume.elements = global_sum(comm, static_cast<long long>(all.J.size()));
  volume.beyond = global_sum(comm, volume.beyond);
  volume.at_edges = global_sum(comm, volume.at_edges);
  volume.least = global_min(comm, volume.least);
  volume.largest = global_max(comm, volume.largest);
  volume.low = quantile(comm, all.J, 0.01, volume.least, volume.largest);
  volume.high = quantile(comm, all.J, 0.99, volume.least, volume.largest);
  volume.place = place_of_least(comm, all.worst, all.place);
}

}  // namespace

std::vector<char> nodes_at_edges(const fields::FieldMesh& mesh) {
  const double most_turned = std::cos(std::acos(-1.0) / 6.0);
  const std::vector<int> bounding = fields::bounding_surfaces(mesh);
  std::vector<Vec3> sum(mesh.n_nodes(), Vec3{});
  std::vector<std::pair<const fields::Face*, Vec3>> normals;
  for (const fields::Face& face : mesh.faces) {
    if (!std::binary_search(bounding.begin(), bounding.end(), face.surface)) continue;
    const auto& v = face.nodes;
    const Vec3 n = unit(cross(mesh.x[v[1]] - mesh.x[v[0]], mesh.x[v[2]] - mesh.x[v[0]]));
    normals.emplace_back(&face, n);
    for (const int a : v) sum[a] += n;
  }
  std::vector<char> is_at_edge(mesh.n_nodes(), 0);
  for (const auto& [face, n] : normals)
    for (const int a : face->nodes)
      if (dot(n, sum[a]) < most_turned * norm(sum[a])) is_at_edge[a] = 1;
  return is_at_edge;
}

LayerVolume layer_volume(const fields::FieldMesh& mesh, int region,
                         const assembly::ElementGeometry& geometry, const std::vector<Vec3>& d,
                         const std::vector<char>& is_at_edge) {
  Elements all;
  Means means(mesh.n_nodes());
  for (std::size_t e = 0; e < mesh.tets.size(); ++e) {
    if (mesh.region[e] != region) continue;
    const auto& nodes = mesh.tets[e];
    auto D = geometry.from_stress_free(e);
    for (int a = 0; a < 4; ++a) D[a] += d[nodes[a]];
    const kernels::Tet4 T = geometry[e];
    const double J = kernels::solid_jacobian_determinant(T, D);
    const bool at_edge =
        std::any_of(nodes.begin(), nodes.end(), [&](int a) { return is_at_edge[a] != 0; });
    means.add(nodes, T.volume, J);
    if (!mesh.is_owned[e]) continue;
    all.J.push_back(J);
    all.is_at_edge.push_back(at_edge ? 1 : 0);
    if (-std::abs(std::log(J)) >= all.worst) continue;
    all.worst = -std::abs(std::log(J));
    all.place = 0.25 * (mesh.x[nodes[0]] + mesh.x[nodes[1]] + mesh.x[nodes[2]] + mesh.x[nodes[3]]);
  }
  LayerVolume volume;
  volume.layer = mesh.regions[region];
  measure_elements(all, *mesh.comm, volume);
  measure_means(means, mesh, is_at_edge, volume);
  return volume;
}

std::vector<LayerVolume> layer_volumes(const problems::SolidProblem& wall) {
  const fields::FieldMesh& mesh = wall.mesh();
  const std::vector<Vec3> d = fields::ghosted_vectors(mesh, wall.state()["displacement"]);
  const std::vector<char> is_at_edge = nodes_at_edges(mesh);
  std::vector<int> is_counted(mesh.regions.size(), 0);
  for (std::size_t e = 0; e < mesh.tets.size(); ++e)
    if (is_counted[mesh.region[e]] == 0 &&
        is_nearly_incompressible(*wall.field().elements().layer(e).law,
                                 1.0 / wall.field().elements().layer(e).coefficients.inv_kappa))
      is_counted[mesh.region[e]] = 1;
  std::vector<LayerVolume> volumes;
  for (std::size_t r = 0; r < is_counted.size(); ++r)
    if (global_max(*mesh.comm, double(is_counted[r])) > 0.0)
      volumes.push_back(
          layer_volume(mesh, static_cast<int>(r), wall.field().elements().geometry, d, is_at_edge));
  return volumes;
}

bool loses_volume(const LayerVolume& volume) {
  return volume.least_mean < lowest || volume.most_mean > highest;
}

std::string text_of(const LayerVolume& volume) {
  std::string text = formatted(
      "\"%s\": 98 %% of its %lld elements have %.3g to %.3g times their volume (det F), single "
      "ones "
      "%.3g to %.3g, the worst at (%.3g, %.3g, %.3g); %lld are beyond 0.9 to 1.1",
      volume.layer.c_str(), volume.elements, volume.low, volume.high, volume.least, volume.largest,
      volume.place[0], volume.place[1], volume.place[2], volume.beyond);
  if (volume.at_edges > 0)
    text += formatted(
        ", %lld of them at sharp edges, where stress is unbounded and finer elements show more",
        volume.at_edges);
  text += formatted(". About nodes they have %.3g to %.3g together", volume.least_mean,
                    volume.most_mean);
  if (!loses_volume(volume))
    return text +
           ": no volume is lost; linear elements of this size vary like this where the strain "
           "varies. Displacements are correct; read the stress at the nodes.";
  return text +
         ": volume is lost. Use a finer mesh, or a larger \"volumetric stabilisation\" in Wall; is "
         "the load as large as intended?";
}

}  // namespace tunica::judge
