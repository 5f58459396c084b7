#include "tunica/mesh/plane_mesh.hpp"

#include <Teuchos_DefaultSerialComm.hpp>
#include <algorithm>
#include <cmath>
#include <map>

#include "tunica/base/error.hpp"
#include "tunica/mesh/faces.hpp"
#include "tunica/mesh/formats/gmsh.hpp"
#include "tunica/mesh/formats/number_tags.hpp"
#include "tunica/mesh/text.hpp"
#include "tunica/mesh/validate.hpp"

namespace tunica::mesh {

namespace {

using Line = std::array<int, 2>;

Line ascending(int a, int b) { return {std::min(a, b), std::max(a, b)}; }

/// Replaces the vertices by those of triangles, and their numbers.
void keep_used(PlaneMesh& plane) {
  std::vector<int> number(plane.vertices.size(), -1);
  for (const auto& triangle : plane.triangles)
    for (const int v : triangle) number[v] = 0;
  std::vector<Vec3> kept;
  for (std::size_t v = 0; v < number.size(); ++v) {
    if (number[v] < 0) continue;
    number[v] = static_cast<int>(kept.size());
    kept.push_back(plane.vertices[v]);
  }
  plane.vertices = std::move(kept);
  for (auto& triangle : plane.triangles)
    for (int& v : triangle) v = number[v];
  std::vector<Line> lines;
  std::vector<int> curves;
  for (std::size_t i = 0; i < plane.lines.size(); ++i) {
    const Line line{number[plane.lines[i][0]], number[plane.lines[i][1]]};
    if (line[0] < 0 || line[1] < 0) continue;
    lines.push_back(line);
    curves.push_back(plane.line_curve[i]);
  }
  plane.lines = std::move(lines);
  plane.line_curve = std::move(curves);
}

void check_plane(const PlaneMesh& plane, const std::string& path) {
  TUNICA_CHECK(!plane.triangles.empty(), path + ": the file has no triangles");
  Vec3 low = plane.vertices[0], high = low;
  for (const Vec3& x : plane.vertices)
    for (int i = 0; i < 3; ++i) {
      low[i] = std::min(low[i], x[i]);
      high[i] = std::max(high[i], x[i]);
    }
  TUNICA_CHECK(high[2] - low[2] <= 1e-9 * norm(high - low),
               path + ": the triangles lie between z = " + show(low[2]) + " and " + show(high[2]) +
                   ", expected a plane z = const");
}

/// The lines with their curves, of which every edge at the boundary or between regions needs one.
std::map<Line, int> curves_of_edges(const PlaneMesh& plane, const std::string& name) {
  std::map<Line, int> curve_of;
  for (std::size_t i = 0; i < plane.lines.size(); ++i)
    curve_of[ascending(plane.lines[i][0], plane.lines[i][1])] = plane.line_curve[i];
  std::map<Line, std::vector<int>> regions_at;
  for (std::size_t t = 0; t < plane.triangles.size(); ++t)
    for (int k = 0; k < 3; ++k)
      regions_at[ascending(plane.triangles[t][k], plane.triangles[t][(k + 1) % 3])].push_back(
          plane.triangle_region[t]);
  for (const auto& [edge, regions] : regions_at) {
    if (regions.size() == 2 && regions[0] == regions[1]) continue;
    TUNICA_CHECK(curve_of.count(edge) > 0,
                 name + ": the edge between " + show(plane.vertices[edge[0]]) + " and " +
                     show(plane.vertices[edge[1]]) +
                     (regions.size() == 1 ? " bounds the mesh" : " lies between two regions") +
                     ", but belongs to no curve. Give its curve a physical group.");
  }
  return curve_of;
}

// A prism is cut by the numbers of its corners, so that all faces conform: from the lowest corner
// of the lower triangle to the highest of the upper one.
void add_prism(const std::array<int, 3>& triangle, int n_plane, Mesh& slab) {
  std::array<int, 3> v = triangle;
  std::sort(v.begin(), v.end());
  const auto [a, b, c] = v;
  const int up = n_plane;
  for (std::array<int, 4> tet :
       {std::array<int, 4>{a, b, c, c + up}, {a, b, b + up, c + up}, {a, a + up, b + up, c + up}}) {
    slab.tets.push_back(tet);
    if (volume(slab, static_cast<int>(slab.tets.size()) - 1) < 0.0)
      std::swap(slab.tets.back()[2], slab.tets.back()[3]);
  }
}

}  // namespace

PlaneMesh read_plane_mesh(const std::string& path) {
  const CommPtr alone = Teuchos::rcp(new Teuchos::SerialComm<int>);
  RowStream rows(alone);
  Curves curves;
  rows.run([&](RowStream& all) { read_gmsh(path, all, &curves); });
  PlaneMesh plane;
  plane.vertices = rows.vertices.take_portions();
  for (const TriangleRow& row : rows.triangles.take_portions()) {
    plane.triangles.push_back(row.corners);
    plane.triangle_region.push_back(row.tag);
  }
  for (std::size_t i = 0; i < curves.lines.size(); ++i) {
    if (curves.tags[i] == 0) continue;  // of no group
    plane.lines.push_back(curves.lines[i]);
    plane.line_curve.push_back(curves.tags[i]);
  }
  keep_used(plane);
  check_plane(plane, path);
  plane.regions = number_tags(rows.surface_names, "region", plane.triangle_region);
  plane.curves = number_tags(curves.names, "surface", plane.line_curve);
  return plane;
}

Mesh drawn_out(const PlaneMesh& plane, double thickness, const std::string& name) {
  TUNICA_CHECK(std::isfinite(thickness) && thickness > 0.0,
               name + ": the thickness is " + show(thickness) + ", expected a positive length");
  const std::map<Line, int> curve_of = curves_of_edges(plane, name);
  const int n = static_cast<int>(plane.vertices.size());
  Mesh slab;
  slab.vertices = plane.vertices;
  for (const Vec3& x : plane.vertices) slab.vertices.push_back(x + Vec3{0.0, 0.0, thickness});
  slab.regions = plane.regions;
  slab.surfaces = plane.curves;
  const int front = static_cast<int>(slab.surfaces.size()), back = front + 1;
  const int id = slab.surfaces.empty() ? 0 : slab.surfaces.back().id;  // the largest
  slab.surfaces.push_back({id + 1, "front"});
  slab.surfaces.push_back({id + 2, "back"});
  for (std::size_t t = 0; t < plane.triangles.size(); ++t) {
    const auto& [a, b, c] = plane.triangles[t];
    add_prism(plane.triangles[t], n, slab);
    slab.tet_region.insert(slab.tet_region.end(), 3, plane.triangle_region[t]);
    slab.triangles.insert(slab.triangles.end(), {{a, b, c}, {a + n, b + n, c + n}});
    slab.triangle_surface.insert(slab.triangle_surface.end(), {back, front});
  }
  for (const auto& [line, curve] : curve_of) {
    const auto [a, b] = line;
    slab.triangles.insert(slab.triangles.end(), {{a, b, b + n}, {a, a + n, b + n}});
    slab.triangle_surface.insert(slab.triangle_surface.end(), 2, curve);
  }
  validate(slab, name);
  return slab;
}

double mean_edge(const PlaneMesh& plane) {
  double sum = 0.0;
  for (const auto& v : plane.triangles)
    for (int k = 0; k < 3; ++k) sum += norm(plane.vertices[v[(k + 1) % 3]] - plane.vertices[v[k]]);
  return sum / (3.0 * static_cast<double>(plane.triangles.size()));
}

}  // namespace tunica::mesh
