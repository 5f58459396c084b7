#include "tunica/app/sanity/vessel.hpp"

#include <algorithm>
#include <cmath>
#include <deque>
#include <numeric>

#include "tunica/mesh/faces.hpp"
#include "tunica/mesh/info.hpp"

namespace tunica::app {

namespace {

constexpr int unreached = -1;

double median(std::vector<double> values) {
  if (values.empty()) return 0.0;
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

template <class T>
bool contains(const std::vector<T>& all, const T& one) {
  return std::find(all.begin(), all.end(), one) != all.end();
}

/// A field's part of a mesh.
struct Part {
  Part(const mesh::Mesh& whole, const std::vector<mesh::Face>& all,
       const std::vector<int>& its_regions)
      : mesh(whole), faces(all), is_inside(whole.tets.size()) {
    std::vector<char> is_mine(mesh.regions.size());
    for (const int r : its_regions) is_mine[r] = 1;
    for (std::size_t t = 0; t < mesh.tets.size(); ++t) is_inside[t] = is_mine[mesh.tet_region[t]];
  }
  bool has(int tet) const { return tet >= 0 && is_inside[tet] != 0; }
  bool is_bounded_by(const mesh::Face& face) const {
    return has(face.tets[0]) != has(face.tets[1]);
  }

  const mesh::Mesh& mesh;
  const std::vector<mesh::Face>& faces;
  std::vector<char> is_inside;  ///< per tet
};

/// The triangles of each surface that bound the part.
std::vector<std::vector<int>> boundary_of(const Part& part) {
  std::vector<std::vector<int>> triangles(part.mesh.surfaces.size());
  for (std::size_t i = 0; i < part.mesh.triangles.size(); ++i) {
    const mesh::Face* face = mesh::find_face(part.faces, part.mesh.triangles[i]);
    if (face != nullptr && part.is_bounded_by(*face))
      triangles[part.mesh.triangle_surface[i]].push_back(static_cast<int>(i));
  }
  return triangles;
}

std::vector<int> pieces_of(const Part& part) {
  std::vector<int> parent(part.mesh.tets.size());
  std::iota(parent.begin(), parent.end(), 0);
  const auto root = [&](int t) {
    while (parent[t] != t) t = parent[t] = parent[parent[t]];
    return t;
  };
  for (const mesh::Face& face : part.faces)
    if (part.has(face.tets[0]) && part.has(face.tets[1]))
      parent[root(face.tets[0])] = root(face.tets[1]);
  std::vector<int> count(part.mesh.tets.size());
  for (std::size_t t = 0; t < count.size(); ++t)
    if (part.is_inside[t]) ++count[root(static_cast<int>(t))];
  count.erase(std::remove(count.begin(), count.end(), 0), count.end());
  std::sort(count.rbegin(), count.rend());
  return count;
}

/// So many edges of the part lead from each vertex to the nearest of some.
std::vector<int> edges_to(const Part& part, const std::vector<char>& from) {
  const std::size_t n = part.mesh.vertices.size();
  std::vector<int> first(n + 1);
  for (std::size_t t = 0; t < part.mesh.tets.size(); ++t)
    if (part.is_inside[t])
      for (const int v : part.mesh.tets[t]) ++first[v + 1];
  std::partial_sum(first.begin(), first.end(), first.begin());
  std::vector<int> tets(first.back()), filled(first.begin(), first.end() - 1);
  for (std::size_t t = 0; t < part.mesh.tets.size(); ++t)
    if (part.is_inside[t])
      for (const int v : part.mesh.tets[t]) tets[filled[v]++] = static_cast<int>(t);
  std::vector<int> edges(n, unreached);
  std::deque<int> next;
  for (std::size_t v = 0; v < n; ++v)
    if (from[v]) {
      edges[v] = 0;
      next.push_back(static_cast<int>(v));
    }
  for (; !next.empty(); next.pop_front()) {
    const int v = next.front();
    for (int k = first[v]; k < first[v + 1]; ++k)
      for (const int w : part.mesh.tets[tets[k]])
        if (edges[w] == unreached) {
          edges[w] = edges[v] + 1;
          next.push_back(w);
        }
  }
  return edges;
}

std::vector<char> vertices_of(const mesh::Mesh& mesh, const std::vector<int>& triangles) {
  std::vector<char> is_there(mesh.vertices.size());
  for (const int i : triangles)
    for (const int v : mesh.triangles[i]) is_there[v] = 1;
  return is_there;
}

double area_of(const mesh::Mesh& mesh, const std::vector<int>& triangles) {
  double sum = 0.0;
  for (const int i : triangles) sum += mesh::area(mesh, mesh.triangles[i]);
  return sum;
}

std::vector<int> joined(const mesh::Mesh& mesh, const std::vector<std::vector<int>>& triangles,
                        const std::vector<std::string>& names) {
  std::vector<int> all;
  for (std::size_t s = 0; s < triangles.size(); ++s)
    if (contains(names, mesh.surfaces[s].name))
      all.insert(all.end(), triangles[s].begin(), triangles[s].end());
  return all;
}

void measure_lumen(const Part& part, const VesselSurfaces& surfaces, Vessel& vessel) {
  const mesh::Mesh& mesh = part.mesh;
  const auto triangles = boundary_of(part);
  const std::vector<int> sides = joined(mesh, triangles, surfaces.lumen_sides);
  const std::vector<int> edges = edges_to(part, vertices_of(mesh, sides));
  for (std::size_t s = 0; s < triangles.size(); ++s) {
    const std::string& name = mesh.surfaces[s].name;
    const bool is_closed =
        contains(surfaces.lumen_sides, name) || contains(surfaces.lumen_planes, name);
    if (triangles[s].empty() || is_closed) continue;
    int deepest = 0;
    for (const int i : triangles[s])
      for (const int v : mesh.triangles[i]) deepest = std::max(deepest, edges[v]);
    vessel.openings.push_back({mesh.surfaces[s].name, area_of(mesh, triangles[s]), 2 * deepest});
  }
  const double area = area_of(mesh, sides);
  if (area == 0.0) return;
  vessel.radius = 2.0 * vessel.fluid->volume / area;
  vessel.length = vessel.fluid->volume / (M_PI * vessel.radius * vessel.radius);
  if (vessel.openings.empty()) {
    vessel.elements_across_lumen = 2 * *std::max_element(edges.begin(), edges.end());
    return;
  }
  const auto fewest =
      std::min_element(vessel.openings.begin(), vessel.openings.end(),
                       [](auto& a, auto& b) { return a.elements_across < b.elements_across; });
  vessel.elements_across_lumen = fewest->elements_across;
}

/// The outer side: surfaces that have no vertex of the inner side. Where there is none, whatever
/// neither is the inside nor holds the wall; ends that are among it do not move the median.
std::vector<int> outside_of(const mesh::Mesh& mesh, const std::vector<std::vector<int>>& triangles,
                            const std::vector<char>& inside, const VesselSurfaces& surfaces) {
  std::vector<int> apart, rest;
  for (std::size_t s = 0; s < triangles.size(); ++s) {
    const std::string& name = mesh.surfaces[s].name;
    if (contains(surfaces.wall_inside, name) || contains(surfaces.wall_ends, name)) continue;
    bool touches = false;
    for (const int i : triangles[s])
      for (const int v : mesh.triangles[i]) touches = touches || inside[v] != 0;
    std::vector<int>& these = touches ? rest : apart;
    these.insert(these.end(), triangles[s].begin(), triangles[s].end());
  }
  return apart.empty() ? rest : apart;
}

/// Thickness t of a wall of volume V around a lumen of radius R with sides of area A:
/// V = A t (1 + t/2R).
double thickness_of(double V, double A, double R) {
  if (R == 0.0) return V / A;
  return R * (std::sqrt(1.0 + 2.0 * V / (A * R)) - 1.0);
}

void measure_wall(const Part& part, const VesselSurfaces& surfaces, Vessel& vessel) {
  const mesh::Mesh& mesh = part.mesh;
  const auto triangles = boundary_of(part);
  const std::vector<int> sides = joined(mesh, triangles, surfaces.wall_inside);
  if (sides.empty()) return;
  const std::vector<char> inside = vertices_of(mesh, sides);
  const std::vector<int> outside = outside_of(mesh, triangles, inside, surfaces);
  if (outside.empty()) return;
  const std::vector<int> edges = edges_to(part, vertices_of(mesh, outside));
  std::vector<double> across;
  for (std::size_t v = 0; v < inside.size(); ++v)
    if (inside[v] && edges[v] > 0) across.push_back(edges[v]);
  vessel.elements_across_wall = static_cast<int>(median(across));
  vessel.thickness = thickness_of(vessel.wall->volume, area_of(mesh, sides), vessel.radius);
}

ElementShapes shapes_of(const Part& part);

}  // namespace

ElementShapes element_shapes(const mesh::Mesh& mesh, const std::vector<int>& regions) {
  const std::vector<mesh::Face> faces = mesh::faces(mesh);
  return shapes_of({mesh, faces, regions});
}

namespace {

ElementShapes shapes_of(const Part& part) {
  const mesh::Mesh& mesh = part.mesh;
  ElementShapes shapes;
  std::vector<double> qualities, edges;
  double smallest = 1e300, largest = 0.0;
  for (int t = 0; t < static_cast<int>(mesh.tets.size()); ++t) {
    if (!part.has(t)) continue;
    const auto x = mesh::corners(mesh, t);
    const double V = mesh::volume(mesh, t), q = mesh::quality(mesh, t);
    if (qualities.empty() || q < shapes.worst_quality) {
      shapes.worst_quality = q;
      shapes.worst_place = 0.25 * (x[0] + x[1] + x[2] + x[3]);
    }
    qualities.push_back(q);
    for (const auto& e : mesh::tet_edges) edges.push_back(norm(x[e[1]] - x[e[0]]));
    shapes.least_angle = std::min(shapes.least_angle, mesh::least_dihedral_angle(x));
    shapes.volume += V;
    smallest = std::min(smallest, V);
    largest = std::max(largest, V);
  }
  shapes.tets = static_cast<int>(qualities.size());
  shapes.pieces = pieces_of(part);
  shapes.median_quality = median(qualities);
  shapes.edge = median(edges);
  if (largest > 0.0) shapes.volume_ratio = largest / smallest;
  return shapes;
}

}  // namespace

Vessel vessel_of(const mesh::Mesh& mesh, const std::vector<mesh::Face>& faces,
                 const std::vector<int>& fluid, const std::vector<int>& wall,
                 const VesselSurfaces& surfaces) {
  Vessel vessel;
  if (!fluid.empty()) {
    const Part part(mesh, faces, fluid);
    vessel.fluid = shapes_of(part);
    measure_lumen(part, surfaces, vessel);
  }
  if (!wall.empty()) {
    const Part part(mesh, faces, wall);
    vessel.wall = shapes_of(part);
    measure_wall(part, surfaces, vessel);
    vessel.region_shares.assign(wall.size(), 0.0);
    for (int t = 0; t < static_cast<int>(mesh.tets.size()); ++t)
      for (std::size_t k = 0; k < wall.size(); ++k)
        if (mesh.tet_region[t] == wall[k])
          vessel.region_shares[k] += mesh::volume(mesh, t) / vessel.wall->volume;
  }
  return vessel;
}

}  // namespace tunica::app
