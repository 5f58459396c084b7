#include "tunica/mesh/info.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <numeric>
#include <set>

#include "tunica/base/sort_once.hpp"
#include "tunica/mesh/faces.hpp"

namespace tunica::mesh {
namespace {

constexpr double huge = std::numeric_limits<double>::max();

/// Vertices of the elements whose tag is the given one.
template <std::size_t N>
std::vector<int> count_vertices(const std::vector<std::array<int, N>>& elements,
                                const std::vector<int>& tag, std::size_t tags,
                                std::size_t vertices) {
  std::vector<int> counts(tags, 0);
  for (std::size_t i = 0; i < tags; ++i) {
    std::vector<bool> is_used(vertices, false);
    for (std::size_t e = 0; e < elements.size(); ++e)
      if (tag[e] == static_cast<int>(i))
        for (const int v : elements[e]) is_used[v] = true;
    counts[i] = static_cast<int>(std::count(is_used.begin(), is_used.end(), true));
  }
  return counts;
}

void measure_tets(const Mesh& mesh, Info& info) {
  const auto vertices =
      count_vertices(mesh.tets, mesh.tet_region, mesh.regions.size(), mesh.vertices.size());
  for (std::size_t r = 0; r < mesh.regions.size(); ++r)
    info.regions.push_back({mesh.regions[r].name, 0, vertices[r], 0.0, huge, 0.0});
  info.worst_quality = huge;
  info.mean_quality = 0.0;
  for (int t = 0; t < static_cast<int>(mesh.tets.size()); ++t) {
    Info::Region& region = info.regions[mesh.tet_region[t]];
    const double q = quality(mesh, t);
    ++region.tets;
    region.volume += volume(mesh, t);
    region.worst_quality = std::min(region.worst_quality, q);
    region.mean_quality += q;
    info.mean_quality += q;
    if (q >= info.worst_quality) continue;
    const auto x = corners(mesh, t);
    info.worst_quality = q;
    info.worst_place = 0.25 * (x[0] + x[1] + x[2] + x[3]);
  }
  info.mean_quality /= static_cast<double>(mesh.tets.size());
  for (Info::Region& region : info.regions) region.mean_quality /= std::max(region.tets, 1);
}

void measure_surfaces(const Mesh& mesh, const std::vector<Face>& all, Info& info) {
  const auto vertices = count_vertices(mesh.triangles, mesh.triangle_surface, mesh.surfaces.size(),
                                       mesh.vertices.size());
  std::vector<std::set<int>> neighbours(mesh.surfaces.size());
  for (std::size_t s = 0; s < mesh.surfaces.size(); ++s)
    info.surfaces.push_back({mesh.surfaces[s].name, 0, vertices[s], 0.0, {}});
  for (std::size_t i = 0; i < mesh.triangles.size(); ++i) {
    Info::Surface& surface = info.surfaces[mesh.triangle_surface[i]];
    ++surface.triangles;
    surface.area += area(mesh, mesh.triangles[i]);
    if (const Face* face = find_face(all, mesh.triangles[i]))
      for (const int t : face->tets)
        if (t >= 0) neighbours[mesh.triangle_surface[i]].insert(mesh.tet_region[t]);
  }
  for (std::size_t s = 0; s < mesh.surfaces.size(); ++s)
    for (const int region : neighbours[s])
      info.surfaces[s].neighbours.push_back(mesh.regions[region].name);
}

void measure_edges(const Mesh& mesh, Info& info) {
  std::vector<std::array<int, 2>> edges;
  edges.reserve(6 * mesh.tets.size());
  for (const auto& tet : mesh.tets)
    for (const auto& e : tet_edges)
      edges.push_back({std::min(tet[e[0]], tet[e[1]]), std::max(tet[e[0]], tet[e[1]])});
  sort_once(edges);
  info.edges = static_cast<int>(edges.size());
  info.shortest_edge = huge;
  info.longest_edge = 0.0;
  for (const auto& e : edges) {
    const double length = norm(mesh.vertices[e[1]] - mesh.vertices[e[0]]);
    info.shortest_edge = std::min(info.shortest_edge, length);
    info.longest_edge = std::max(info.longest_edge, length);
  }
}

void measure_contacts(const Mesh& mesh, const std::vector<Face>& all, Info& info) {
  std::set<const Face*> tagged;
  for (const auto& triangle : mesh.triangles) tagged.insert(find_face(all, triangle));
  std::map<std::pair<int, int>, Info::Contact> contacts;
  for (const Face& face : all) {
    if (face.is_boundary()) continue;
    const auto [a, b] = std::minmax({mesh.tet_region[face.tets[0]], mesh.tet_region[face.tets[1]]});
    if (a == b) continue;
    auto& contact = contacts[{a, b}];
    contact.first = mesh.regions[a].name;
    contact.second = mesh.regions[b].name;
    ++contact.faces;
    contact.tagged_faces += static_cast<int>(tagged.count(&face));
  }
  for (const auto& entry : contacts) info.contacts.push_back(entry.second);
}

int count_pieces(const Mesh& mesh, const std::vector<Face>& all) {
  std::vector<int> parent(mesh.tets.size());
  std::iota(parent.begin(), parent.end(), 0);
  const auto root = [&](int t) {
    while (parent[t] != t) t = parent[t] = parent[parent[t]];
    return t;
  };
  int pieces = static_cast<int>(mesh.tets.size());
  for (const Face& face : all) {
    if (face.is_boundary()) continue;
    const int a = root(face.tets[0]), b = root(face.tets[1]);
    if (a == b) continue;
    parent[std::max(a, b)] = std::min(a, b);
    --pieces;
  }
  return pieces;
}

/// Vertices closer than the tolerance to another one that comes before them along a direction
/// which is askew to every plane that meshes are usually aligned with.
int count_twins(const Mesh& mesh, double tolerance) {
  const Vec3 askew{0.6180, 0.5347, 0.5764};
  std::vector<std::pair<double, int>> order;
  for (std::size_t v = 0; v < mesh.vertices.size(); ++v)
    order.emplace_back(dot(askew, mesh.vertices[v]), static_cast<int>(v));
  std::sort(order.begin(), order.end());
  int twins = 0;
  for (std::size_t i = 0; i < order.size(); ++i)
    for (std::size_t j = i; j-- > 0 && order[i].first - order[j].first <= tolerance;)
      if (norm(mesh.vertices[order[i].second] - mesh.vertices[order[j].second]) <= tolerance) {
        ++twins;
        break;
      }
  return twins;
}

void measure_box(const Mesh& mesh, Info& info) {
  info.low = {huge, huge, huge};
  info.high = {-huge, -huge, -huge};
  for (const Vec3& x : mesh.vertices)
    for (int i = 0; i < 3; ++i) {
      info.low[i] = std::min(info.low[i], x[i]);
      info.high[i] = std::max(info.high[i], x[i]);
    }
}

}  // namespace

double quality(const Mesh& mesh, int tet) { return quality(corners(mesh, tet)); }

double quality(const std::array<Vec3, 4>& x) {
  double sum = 0.0;
  for (const auto& e : tet_edges) sum += dot(x[e[1]] - x[e[0]], x[e[1]] - x[e[0]]);
  return 12.0 * std::cbrt(std::pow(3.0 * signed_volume(x[0], x[1], x[2], x[3]), 2)) / sum;
}

double least_dihedral_angle(const std::array<Vec3, 4>& x) {
  std::array<Vec3, 4> normals;
  for (int f = 0; f < 4; ++f) {
    const auto& v = tet_faces[f];
    const Vec3 normal = cross(x[v[1]] - x[v[0]], x[v[2]] - x[v[0]]);
    normals[f] = unit(normal);
  }
  double most = -1.0;  // cosine of the angle within
  for (int f = 0; f < 4; ++f)
    for (int g = 0; g < f; ++g) most = std::max(most, -dot(normals[f], normals[g]));
  return std::acos(std::min(1.0, most)) * 180.0 / std::acos(-1.0);
}

Info inspect(const Mesh& mesh) {
  const std::vector<Face> all = faces(mesh);
  Info info{};
  info.vertices = static_cast<int>(mesh.vertices.size());
  info.tets = static_cast<int>(mesh.tets.size());
  info.triangles = static_cast<int>(mesh.triangles.size());
  info.faces = static_cast<int>(all.size());
  info.pieces = count_pieces(mesh, all);
  measure_tets(mesh, info);
  measure_surfaces(mesh, all, info);
  measure_edges(mesh, info);
  measure_contacts(mesh, all, info);
  measure_box(mesh, info);
  for (const TetVectors& vectors : mesh.tet_vectors) info.tet_vectors.push_back(vectors.name);
  info.twin_vertices = count_twins(mesh, 1e-6 * info.shortest_edge);
  return info;
}

}  // namespace tunica::mesh
