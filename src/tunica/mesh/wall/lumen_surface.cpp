#include "tunica/mesh/wall/lumen_surface.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>
#include <set>

#include "tunica/base/error.hpp"
#include "tunica/base/sort_once.hpp"
#include "tunica/mesh/faces.hpp"
#include "tunica/mesh/text.hpp"
#include "tunica/mesh/validate.hpp"

namespace tunica::mesh::wall {
namespace {

constexpr double flat = 1e-3;  ///< a cap is, if its vertices leave its plane by less of its width

/// A triangle of the mesh's boundary, its normal outward.
struct Outward {
  std::array<int, 3> vertices;
  int triangle;
  bool is_wall;
};

/// One side of an edge of the boundary.
struct EdgeSide {
  std::array<int, 2> ends;  ///< ascending
  int outward;              ///< position among the boundary's triangles
  std::array<int, 2> directed;
};

std::vector<Outward> boundary(const Mesh& mesh, const std::vector<bool>& is_wall) {
  const std::vector<Face> all = faces(mesh);
  std::vector<Outward> result;
  for (std::size_t i = 0; i < mesh.triangles.size(); ++i) {
    std::array<int, 3> v = mesh.triangles[i];
    const Face& face = *find_face(all, v);
    const int surface = mesh.triangle_surface[i];
    TUNICA_CHECK(!is_wall[surface] || face.is_boundary(),
                 "wall: the triangle at " + show(centre(mesh, v)) + " of surface \"" +
                     mesh.surfaces[surface].name +
                     "\" lies between two tetrahedra, expected one on the outside of the lumen. "
                     "Give a mesh of the lumen alone.");
    if (!face.is_boundary()) continue;
    for (const int apex : mesh.tets[face.tets[0]]) {
      if (std::find(v.begin(), v.end(), apex) != v.end()) continue;
      const Vec3& a = mesh.vertices[v[0]];
      if (signed_volume(a, mesh.vertices[v[1]], mesh.vertices[v[2]], mesh.vertices[apex]) > 0.0)
        std::swap(v[1], v[2]);
    }
    result.push_back({v, static_cast<int>(i), is_wall[surface]});
  }
  return result;
}

std::vector<EdgeSide> edge_sides(const std::vector<Outward>& all) {
  std::vector<EdgeSide> sides;
  for (std::size_t i = 0; i < all.size(); ++i)
    for (int k = 0; k < 3; ++k) {
      const int a = all[i].vertices[k], b = all[i].vertices[(k + 1) % 3];
      sides.push_back({{std::min(a, b), std::max(a, b)}, static_cast<int>(i), {a, b}});
    }
  std::sort(sides.begin(), sides.end(),
            [](const EdgeSide& a, const EdgeSide& b) { return a.ends < b.ends; });
  return sides;
}

Vec3 area_vector_of(const Mesh& mesh, const std::array<int, 3>& v) {
  const Vec3& a = mesh.vertices[v[0]];
  return 0.5 * cross(mesh.vertices[v[1]] - a, mesh.vertices[v[2]] - a);
}

/// The connected pieces of the surfaces beside the wall, and the planes of those that are flat.
class Caps {
public:
  Caps(const Mesh& mesh, const std::vector<Outward>& all, const std::vector<EdgeSide>& sides)
      : mesh_(mesh), all_(all), parent_(all.size()) {
    std::iota(parent_.begin(), parent_.end(), 0);
    for (std::size_t i = 1; i < sides.size(); ++i)
      if (sides[i].ends == sides[i - 1].ends &&
          surface(sides[i].outward) == surface(sides[i - 1].outward))
        parent_[root(sides[i].outward)] = root(sides[i - 1].outward);
    for (std::size_t i = 0; i < all.size(); ++i)
      if (!all[i].is_wall) pieces_[root(static_cast<int>(i))].push_back(static_cast<int>(i));
    for (const auto& [key, members] : pieces_) measure(key, members);
  }

  int surface(int outward) const { return mesh_.triangle_surface[all_[outward].triangle]; }
  /// Normal of the cap's plane, or of this triangle of it if it is not flat.
  Vec3 normal(int outward) {
    const auto found = planes_.find(root(outward));
    return found != planes_.end() ? found->second
                                  : unit(area_vector_of(mesh_, all_[outward].vertices));
  }
  bool is_flat(int outward) { return planes_.count(root(outward)) == 1; }

private:
  int root(int i) {
    while (parent_[i] != i) i = parent_[i] = parent_[parent_[i]];
    return i;
  }

  void measure(int key, const std::vector<int>& members) {
    Vec3 sum{};
    for (const int i : members) sum += area_vector_of(mesh_, all_[i].vertices);
    const double width = std::sqrt(norm(sum));
    if (width == 0.0) return;  // closed
    const Vec3 plane = unit(sum), origin = mesh_.vertices[all_[members[0]].vertices[0]];
    double low = 0.0, high = 0.0;
    for (const int i : members)
      for (const int v : all_[i].vertices) {
        const double height = dot(plane, mesh_.vertices[v] - origin);
        low = std::min(low, height);
        high = std::max(high, height);
      }
    if (high - low <= flat * width) planes_[key] = plane;
  }

  const Mesh& mesh_;
  const std::vector<Outward>& all_;
  std::vector<int> parent_;
  std::map<int, std::vector<int>> pieces_;
  std::map<int, Vec3> planes_;
};

Lists make_lists(int vertices, std::vector<std::array<int, 2>> pairs) {
  sort_once(pairs);
  Lists lists;
  lists.begin.assign(vertices + 1, 0);
  for (const auto& [v, item] : pairs) {
    ++lists.begin[v + 1];
    lists.items.push_back(item);
  }
  std::partial_sum(lists.begin.begin(), lists.begin.end(), lists.begin.begin());
  return lists;
}

/// Numbers the vertices of the wall's triangles, keeping their order.
std::vector<int> add_vertices(const Mesh& mesh, const std::vector<Outward>& all,
                              LumenSurface& surface) {
  std::vector<int> number(mesh.vertices.size(), -1);
  for (const Outward& each : all)
    if (each.is_wall)
      for (const int v : each.vertices) number[v] = 0;
  for (std::size_t v = 0; v < number.size(); ++v) {
    if (number[v] < 0) continue;
    number[v] = surface.vertices();
    surface.mesh_vertex.push_back(static_cast<int>(v));
    surface.x.push_back(mesh.vertices[v]);
  }
  return number;
}

void add_triangles(const std::vector<Outward>& all, const std::vector<int>& number,
                   LumenSurface& surface) {
  std::vector<std::array<int, 2>> of_vertex, neighbours;
  for (const Outward& each : all) {
    if (!each.is_wall) continue;
    const int t = static_cast<int>(surface.triangles.size());
    const std::array<int, 3> v{number[each.vertices[0]], number[each.vertices[1]],
                               number[each.vertices[2]]};
    surface.triangles.push_back(v);
    surface.mesh_triangle.push_back(each.triangle);
    for (int k = 0; k < 3; ++k) {
      of_vertex.push_back({v[k], t});
      neighbours.push_back({v[k], v[(k + 1) % 3]});
      neighbours.push_back({v[(k + 1) % 3], v[k]});
    }
  }
  surface.triangles_of = make_lists(surface.vertices(), std::move(of_vertex));
  surface.neighbours_of = make_lists(surface.vertices(), std::move(neighbours));
}

/// Different planes only: an edge between two triangles of one bent cap has one plane after all.
void add_plane(std::vector<Vec3>& planes, const Vec3& plane) {
  constexpr double different = 0.05;
  for (Vec3& each : planes) {
    if (norm(each - plane) > different) continue;
    if (norm(each - plane) > 1e-12) each = unit(each + plane);
    return;
  }
  planes.push_back(plane);
}

void add_rim(const Mesh& mesh, const std::vector<Outward>& all, const std::vector<int>& number,
             LumenSurface& surface) {
  const std::vector<EdgeSide> sides = edge_sides(all);
  Caps caps(mesh, all, sides);
  surface.planes_of.resize(surface.x.size());
  std::set<std::string> bent;
  for (std::size_t i = 0, next = 0; i < sides.size(); i = next) {
    for (next = i; next < sides.size() && sides[next].ends == sides[i].ends;) ++next;
    TUNICA_CHECK(next - i == 2, "wall: " + std::to_string(next - i) +
                                    " triangles of the boundary meet in the edge at " +
                                    show(mesh.vertices[sides[i].ends[0]]) +
                                    ", expected 2: the lumen touches itself there");
    if (all[sides[i].outward].is_wall == all[sides[i + 1].outward].is_wall) continue;
    const bool is_first = all[sides[i].outward].is_wall;
    const EdgeSide& wall = sides[is_first ? i : i + 1];
    const int cap = sides[is_first ? i + 1 : i].outward;
    const std::array<int, 2> ends{number[wall.directed[0]], number[wall.directed[1]]};
    surface.rim.push_back({ends, caps.surface(cap)});
    for (const int v : ends) add_plane(surface.planes_of[v], caps.normal(cap));
    if (!caps.is_flat(cap)) bent.insert(mesh.surfaces[caps.surface(cap)].name);
  }
  surface.bent_caps.assign(bent.begin(), bent.end());
}

}  // namespace

Vec3 LumenSurface::area_vector(int triangle) const {
  const auto& v = triangles[triangle];
  return 0.5 * cross(x[v[1]] - x[v[0]], x[v[2]] - x[v[0]]);
}

Vec3 LumenSurface::normal(int triangle) const { return unit(area_vector(triangle)); }

LumenSurface lumen_surface(const Mesh& mesh, const std::vector<std::string>& surfaces) {
  std::vector<bool> is_wall(mesh.surfaces.size(), false);
  TUNICA_CHECK(!surfaces.empty(),
               "wall: no surface is named, expected those of the lumen on "
               "which a wall is to grow");
  for (const std::string& name : surfaces) is_wall[surface_index(mesh, name)] = true;
  const std::vector<Outward> all = boundary(mesh, is_wall);
  LumenSurface surface;
  const std::vector<int> number = add_vertices(mesh, all, surface);
  add_triangles(all, number, surface);
  add_rim(mesh, all, number, surface);
  return surface;
}

}  // namespace tunica::mesh::wall
