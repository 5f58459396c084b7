#include "tunica/judge/vessel.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <numeric>
#include <tuple>

#include "tunica/base/reduce.hpp"
#include "tunica/base/rows.hpp"
#include "tunica/judge/global_median.hpp"
#include "tunica/judge/place_of_least.hpp"
#include "tunica/mesh/faces.hpp"
#include "tunica/mesh/info.hpp"
#include "tunica/mesh/validate.hpp"

namespace tunica::judge {

namespace {

constexpr int unreached = std::numeric_limits<int>::max();

template <class T>
bool contains(const std::vector<T>& all, const T& one) {
  return std::find(all.begin(), all.end(), one) != all.end();
}

/// A field's part of a mesh.
struct Part {
  Part(const mesh::Share& its_share, const std::vector<int>& regions)
      : share(its_share), mesh(its_share.mesh), comm(*its_share.comm),
        is_in(mesh::marked_regions(mesh, regions)) {}
  bool has(std::size_t tet) const { return is_in[mesh.tet_region[tet]] != 0; }
  /// Of all ranks exactly one.
  bool counts(std::size_t tet) const { return has(tet) && share.counts(tet); }

  const mesh::Share& share;
  const mesh::Mesh& mesh;
  const Comm& comm;
  std::vector<char> is_in;  ///< per region
};

/// The triangles of each surface that bound the part: all at the rank's own vertices.
std::vector<std::vector<int>> boundary_of(const Part& part) {
  std::vector<std::vector<int>> triangles(part.mesh.surfaces.size());
  for (std::size_t i = 0; i < part.mesh.triangles.size(); ++i)
    if (part.share.is_between(i, part.is_in))
      triangles[part.mesh.triangle_surface[i]].push_back(static_cast<int>(i));
  return triangles;
}

/// Sets of numbers that are joined one pair at a time.
class Sets {
public:
  long long root(long long number) {
    auto found = parent_.emplace(number, number).first;
    while (found->second != found->first) found = parent_.find(found->second);
    return parent_[number] = found->first;
  }
  void join(long long a, long long b) { parent_[root(a)] = root(b); }

private:
  std::map<long long, long long> parent_;
};

/// What is connected on the rank, per tetrahedron: the number of one of them.
std::vector<int> local_pieces(const Part& part) {
  std::vector<int> parent(part.mesh.tets.size());
  std::iota(parent.begin(), parent.end(), 0);
  const auto root = [&](int t) {
    while (parent[t] != t) t = parent[t] = parent[parent[t]];
    return t;
  };
  mesh::for_each_face(mesh::Excerpt(part.mesh), "mesh", [&](const mesh::Face& face) {
    if (!face.is_boundary() && part.has(face.tets[0]) && part.has(face.tets[1]))
      parent[root(face.tets[0])] = root(face.tets[1]);
  });
  for (std::size_t t = 0; t < parent.size(); ++t) parent[t] = root(static_cast<int>(t));
  return parent;
}

struct Pair {
  long long a, b;
  bool operator<(const Pair& other) const { return std::tie(a, b) < std::tie(other.a, other.b); }
};

/// Two ranks that know the same tetrahedron join their pieces. The result is on rank 0.
std::vector<long long> pieces_of(const Part& part) {
  const std::vector<int> piece = local_pieces(part);
  const std::vector<long long>& number = part.share.numbers.tets;
  std::vector<Pair> known;  // a tetrahedron of another rank's part, and its piece here
  std::vector<int> ranks;
  std::map<long long, long long> counts;
  for (std::size_t t = 0; t < piece.size(); ++t) {
    if (!part.has(t)) continue;
    if (part.share.counts(t)) {
      ++counts[number[piece[t]]];
    } else {
      known.push_back({number[t], number[piece[t]]});
      ranks.push_back(part.share.tet_part[t]);
    }
  }
  std::vector<Pair> joints;
  for (const Pair& at : exchange_to(part.comm, known, ranks).items) {
    const auto t = std::lower_bound(number.begin(), number.end(), at.a) - number.begin();
    joints.push_back({number[piece[t]], at.b});
  }
  std::sort(joints.begin(), joints.end());
  joints.erase(std::unique(joints.begin(), joints.end(),
                           [](const Pair& x, const Pair& y) { return !(x < y) && !(y < x); }),
               joints.end());
  std::vector<Pair> mine;
  for (const auto& [root, count] : counts) mine.push_back({root, count});
  Sets sets;
  for (const Pair& joint : gather_rows(part.comm, joints)) sets.join(joint.a, joint.b);
  std::map<long long, long long> sums;
  for (const Pair& counted : gather_rows(part.comm, mine)) sums[sets.root(counted.a)] += counted.b;
  std::vector<long long> pieces;
  for (const auto& [root, count] : sums) pieces.push_back(count);
  std::sort(pieces.rbegin(), pieces.rend());
  return pieces;
}

/// So many edges of the part lead from each vertex to the nearest of some: those that ranks mark at
/// their own vertices.
std::vector<int> edges_to(const Part& part, const std::vector<char>& from) {
  std::vector<int> edges(from.size(), unreached);
  for (std::size_t v = 0; v < from.size(); ++v)
    if (from[v] && part.share.is_owned[v]) edges[v] = 0;
  const auto sweep = [&] {
    bool is_changed = false;
    for (std::size_t t = 0; t < part.mesh.tets.size(); ++t) {
      if (!part.has(t)) continue;
      int least = unreached;
      for (const int v : part.mesh.tets[t]) least = std::min(least, edges[v]);
      if (least == unreached) continue;
      for (const int v : part.mesh.tets[t])
        if (edges[v] > least + 1) {
          edges[v] = least + 1;
          is_changed = true;
        }
    }
    return is_changed;
  };
  for (bool is_changed = true; is_changed;) {
    std::vector<int> of_owners = edges;
    part.share.ghosts.update(of_owners);
    is_changed = false;
    for (std::size_t v = 0; v < edges.size(); ++v)
      if (of_owners[v] < edges[v]) {
        edges[v] = of_owners[v];
        is_changed = true;
      }
    while (sweep()) is_changed = true;
    is_changed = global_max(part.comm, is_changed ? 1.0 : 0.0) > 0.5;
  }
  return edges;
}

std::vector<char> vertices_of(const mesh::Mesh& mesh, const std::vector<int>& triangles) {
  std::vector<char> is_there(mesh.vertices.size());
  for (const int i : triangles)
    for (const int v : mesh.triangles[i]) is_there[v] = 1;
  return is_there;
}

/// Of all ranks.
double area_of(const Part& part, const std::vector<int>& triangles) {
  const mesh::Excerpt mine = part.share.excerpt();
  double sum = 0.0;
  for (const int i : triangles)
    if (mine.has(part.mesh.triangles[i])) sum += mesh::area(part.mesh, part.mesh.triangles[i]);
  return global_sum(part.comm, sum);
}

std::vector<int> joined(const mesh::Mesh& mesh, const std::vector<std::vector<int>>& triangles,
                        const std::vector<std::string>& names) {
  std::vector<int> all;
  for (std::size_t s = 0; s < triangles.size(); ++s)
    if (contains(names, mesh.surfaces[s].name))
      all.insert(all.end(), triangles[s].begin(), triangles[s].end());
  return all;
}

/// What planes of symmetry leave of a circle of radius R, by the openings.
double share_of_circle(const std::vector<Vessel::Opening>& openings, double R) {
  double sum = 0.0;
  for (const Vessel::Opening& o : openings) sum += o.area;
  return std::min(1.0, sum / (M_PI * R * R * static_cast<double>(openings.size())));
}

void measure_lumen(const Part& part, const VesselSurfaces& surfaces, Vessel& vessel) {
  const mesh::Mesh& mesh = part.mesh;
  const auto triangles = boundary_of(part);
  const std::vector<int> sides = joined(mesh, triangles, surfaces.lumen_sides);
  const std::vector<int> edges = edges_to(part, vertices_of(mesh, sides));
  const auto reached = [&](std::size_t v) { return edges[v] == unreached ? -1 : edges[v]; };
  for (std::size_t s = 0; s < triangles.size(); ++s) {
    const std::string& name = mesh.surfaces[s].name;
    const bool is_closed =
        contains(surfaces.lumen_sides, name) || contains(surfaces.lumen_planes, name);
    const double area = area_of(part, triangles[s]);
    if (area == 0.0 || is_closed) continue;
    int deepest = 0;
    for (const int i : triangles[s])
      for (const int v : mesh.triangles[i]) deepest = std::max(deepest, reached(v));
    deepest = static_cast<int>(global_max(part.comm, deepest));
    vessel.openings.push_back({name, area, 2 * deepest});
  }
  const double area = area_of(part, sides);
  if (area == 0.0) return;
  vessel.radius = 2.0 * vessel.fluid->volume / area;
  vessel.length = vessel.fluid->volume / (M_PI * vessel.radius * vessel.radius);
  if (vessel.openings.empty()) {
    int deepest = 0;
    for (std::size_t v = 0; v < edges.size(); ++v) deepest = std::max(deepest, reached(v));
    vessel.elements_across_lumen = 2 * static_cast<int>(global_max(part.comm, deepest));
    return;
  }
  if (!surfaces.lumen_planes.empty())
    vessel.length /= share_of_circle(vessel.openings, vessel.radius);
  const auto fewest =
      std::min_element(vessel.openings.begin(), vessel.openings.end(),
                       [](auto& x, auto& y) { return x.elements_across < y.elements_across; });
  vessel.elements_across_lumen = fewest->elements_across;
}

/// The outer side: surfaces that have no vertex of the inner side. Where there is none, whatever
/// neither is the inside nor holds the wall; ends that are among it do not move the median.
std::vector<int> outside_of(const Part& part, const std::vector<std::vector<int>>& triangles,
                            const std::vector<char>& inside, const VesselSurfaces& surfaces) {
  const mesh::Mesh& mesh = part.mesh;
  std::vector<int> apart, rest;
  double are_apart = 0.0;
  for (std::size_t s = 0; s < triangles.size(); ++s) {
    const std::string& name = mesh.surfaces[s].name;
    if (contains(surfaces.wall_inside, name) || contains(surfaces.wall_ends, name)) continue;
    double touches = 0.0;
    for (const int i : triangles[s])
      for (const int v : mesh.triangles[i])
        if (part.share.is_owned[v] && inside[v]) touches = 1.0;
    touches = global_max(part.comm, touches);
    if (touches == 0.0) are_apart += static_cast<double>(triangles[s].size());
    std::vector<int>& these = touches > 0.0 ? rest : apart;
    these.insert(these.end(), triangles[s].begin(), triangles[s].end());
  }
  return global_sum(part.comm, are_apart) == 0.0 ? rest : apart;
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
  const double area = area_of(part, sides);
  if (area == 0.0) return;
  const std::vector<char> inside = vertices_of(mesh, sides);
  const std::vector<int> outside = outside_of(part, triangles, inside, surfaces);
  if (area_of(part, outside) == 0.0) return;
  const std::vector<int> edges = edges_to(part, vertices_of(mesh, outside));
  vessel.elements_across_wall =
      static_cast<int>(std::lround(global_median(part.comm, [&](const auto& visit) {
        for (std::size_t v = 0; v < inside.size(); ++v)
          if (part.share.is_owned[v] && inside[v] && edges[v] > 0 && edges[v] != unreached)
            visit(edges[v]);
      })));
  vessel.thickness = thickness_of(vessel.wall->volume, area, vessel.radius);
}

/// The wall's surface around an opening: that with most of the vertices at which the opening meets
/// the inside of the wall. A plane of symmetry has two of them.
void find_ends(const Part& fluid, const Part& wall, const VesselSurfaces& surfaces,
               Vessel& vessel) {
  const mesh::Mesh& mesh = wall.mesh;
  const auto of_fluid = boundary_of(fluid), of_wall = boundary_of(wall);
  const std::vector<char> inside = vertices_of(mesh, joined(mesh, of_wall, surfaces.wall_inside));
  const std::size_t n_openings = vessel.openings.size(), n_surfaces = mesh.surfaces.size();
  std::vector<int> opening(mesh.vertices.size(), -1);  // at whose rim a vertex is
  std::vector<double> rim(n_openings, 0.0), shared(n_openings * n_surfaces, 0.0);
  for (std::size_t k = 0; k < n_openings; ++k) {
    const int s = mesh::surface_index(mesh, vessel.openings[k].surface);
    const std::vector<char> is_there = vertices_of(mesh, of_fluid[s]);
    for (std::size_t v = 0; v < opening.size(); ++v)
      if (is_there[v] && inside[v] && wall.share.is_owned[v]) {
        opening[v] = static_cast<int>(k);
        rim[k] += 1.0;
      }
  }
  for (std::size_t s = 0; s < n_surfaces; ++s) {
    if (contains(surfaces.wall_inside, mesh.surfaces[s].name)) continue;
    const std::vector<char> is_there = vertices_of(mesh, of_wall[s]);
    for (std::size_t v = 0; v < opening.size(); ++v)
      if (is_there[v] && opening[v] >= 0) shared[opening[v] * n_surfaces + s] += 1.0;
  }
  rim = global_sum(wall.comm, rim);
  shared = global_sum(wall.comm, shared);
  for (std::size_t k = 0; k < n_openings; ++k) {
    const auto first = shared.begin() + static_cast<std::ptrdiff_t>(k * n_surfaces);
    const auto most = std::max_element(first, first + static_cast<std::ptrdiff_t>(n_surfaces));
    if (*most > 0.5 * rim[k]) vessel.openings[k].wall_end = mesh.surfaces[most - first].name;
  }
}

ElementShapes shapes_of(const Part& part) {
  const mesh::Mesh& mesh = part.mesh;
  ElementShapes shapes;
  double smallest = 1e300, largest = 0.0, tets = 0.0;
  for (std::size_t t = 0; t < mesh.tets.size(); ++t) {
    if (!part.counts(t)) continue;
    const auto x = mesh::corners(mesh, static_cast<int>(t));
    const double V = mesh::volume(mesh, static_cast<int>(t)), q = mesh::quality(x);
    if (tets++ == 0.0 || q < shapes.worst_quality) {
      shapes.worst_quality = q;
      shapes.worst_place = 0.25 * (x[0] + x[1] + x[2] + x[3]);
    }
    shapes.least_angle = std::min(shapes.least_angle, mesh::least_dihedral_angle(x));
    shapes.volume += V;
    smallest = std::min(smallest, V);
    largest = std::max(largest, V);
  }
  const double mine = tets == 0.0 ? std::numeric_limits<double>::infinity() : shapes.worst_quality;
  shapes.worst_quality = global_min(part.comm, mine);
  shapes.worst_place = place_of_least(part.comm, mine, shapes.worst_place);
  shapes.least_angle = global_min(part.comm, shapes.least_angle);
  shapes.volume = global_sum(part.comm, shapes.volume);
  smallest = global_min(part.comm, smallest);
  largest = global_max(part.comm, largest);
  shapes.tets = static_cast<long long>(global_sum(part.comm, tets));
  shapes.pieces = on_all_ranks(part.comm, pieces_of(part));
  const auto for_each_tet = [&](const auto& visit) {
    for (std::size_t t = 0; t < mesh.tets.size(); ++t)
      if (part.counts(t)) visit(mesh::corners(mesh, static_cast<int>(t)));
  };
  shapes.median_quality = global_median(part.comm, [&](const auto& visit) {
    for_each_tet([&](const auto& x) { visit(mesh::quality(x)); });
  });
  shapes.edge = global_median(part.comm, [&](const auto& visit) {
    for_each_tet([&](const auto& x) {
      for (const auto& e : mesh::tet_edges) visit(norm(x[e[1]] - x[e[0]]));
    });
  });
  if (largest > 0.0) shapes.volume_ratio = largest / smallest;
  return shapes;
}

}  // namespace

ElementShapes element_shapes(const mesh::Share& share, const std::vector<int>& regions) {
  return shapes_of({share, regions});
}

Vessel vessel_of(const mesh::Share& share, const std::vector<int>& fluid,
                 const std::vector<int>& wall, const VesselSurfaces& surfaces) {
  Vessel vessel;
  if (!fluid.empty()) {
    const Part part(share, fluid);
    vessel.fluid = shapes_of(part);
    measure_lumen(part, surfaces, vessel);
  }
  if (!wall.empty()) {
    const Part part(share, wall);
    vessel.wall = shapes_of(part);
    measure_wall(part, surfaces, vessel);
    if (!fluid.empty()) find_ends(Part(share, fluid), part, surfaces, vessel);
    vessel.region_shares.assign(wall.size(), 0.0);
    for (std::size_t t = 0; t < share.mesh.tets.size(); ++t)
      for (std::size_t k = 0; k < wall.size(); ++k)
        if (share.counts(t) && share.mesh.tet_region[t] == wall[k])
          vessel.region_shares[k] +=
              mesh::volume(share.mesh, static_cast<int>(t)) / vessel.wall->volume;
    vessel.region_shares = global_sum(*share.comm, vessel.region_shares);
  }
  return vessel;
}

}  // namespace tunica::judge
