#include "tunica/mesh/raw_mesh.hpp"

#include <algorithm>

#include "tunica/base/error.hpp"
#include "tunica/mesh/faces.hpp"
#include "tunica/mesh/text.hpp"
#include "tunica/mesh/validate.hpp"

namespace tunica::mesh {

std::vector<Tag> number_tags(std::map<int, std::string> names, const std::string& kind,
                             std::vector<int>& numbers) {
  std::map<int, int> position;
  for (const int id : numbers) position[id] = 0;
  std::vector<Tag> tags;
  for (auto& [id, at] : position) {
    at = static_cast<int>(tags.size());
    const std::string& name = names[id];
    tags.push_back({id, name.empty() ? kind + "-" + std::to_string(id) : name});
  }
  for (int& id : numbers) id = position[id];
  return tags;
}

namespace {

void orient(Mesh& mesh, const RawMesh& raw) {
  const int n = static_cast<int>(mesh.tets.size());
  bool are_all_negative = true;
  for (int t = 0; t < n && are_all_negative; ++t) are_all_negative = volume(mesh, t) < 0.0;
  if (are_all_negative)
    for (auto& tet : mesh.tets) std::swap(tet[2], tet[3]);
  for (int t = 0; t < n; ++t) {
    const double V = volume(mesh, t);
    TUNICA_CHECK(V > 0.0, raw.path + ": inverted element: element " +
                              std::to_string(raw.tet_number[t]) + " of region \"" +
                              mesh.regions[mesh.tet_region[t]].name + "\" at " +
                              show(corners(mesh, t)[0]) + " has volume " + show(V) +
                              ", expected a positive one");
  }
}

void drop_untagged_triangles(RawMesh& raw, const Mesh& mesh) {
  if (std::count(raw.triangle_tag.begin(), raw.triangle_tag.end(), 0) == 0) return;
  const std::vector<Face> all = faces(mesh, raw.path);
  std::size_t kept = 0;
  for (std::size_t i = 0; i < raw.triangles.size(); ++i) {
    const Face* face = find_face(all, raw.triangles[i]);
    if (raw.triangle_tag[i] == 0 && !(face && face->is_boundary())) continue;
    raw.triangles[kept] = raw.triangles[i];
    raw.triangle_tag[kept++] = raw.triangle_tag[i];
  }
  raw.triangles.resize(kept);
  raw.triangle_tag.resize(kept);
}

void drop_unused_vertices(Mesh& mesh) {
  std::vector<int> position(mesh.vertices.size(), -1);
  for (const auto& tet : mesh.tets)
    for (const int v : tet) position[v] = 0;
  for (const auto& triangle : mesh.triangles)
    for (const int v : triangle) position[v] = 0;
  int kept = 0;
  for (std::size_t v = 0; v < position.size(); ++v) {
    if (position[v] < 0) continue;
    mesh.vertices[kept] = mesh.vertices[v];
    position[v] = kept++;
  }
  mesh.vertices.resize(kept);
  for (auto& tet : mesh.tets)
    for (int& v : tet) v = position[v];
  for (auto& triangle : mesh.triangles)
    for (int& v : triangle) v = position[v];
}

}  // namespace

Mesh finish(RawMesh raw) {
  TUNICA_CHECK(!raw.tets.empty(), raw.path + ": the file has no tetrahedra");
  Mesh mesh;
  mesh.vertices = std::move(raw.vertices);
  mesh.tets = std::move(raw.tets);
  mesh.tet_vectors = std::move(raw.tet_vectors);
  mesh.tet_region = std::move(raw.tet_tag);
  mesh.regions = number_tags(raw.region_names, "region", mesh.tet_region);
  orient(mesh, raw);
  drop_untagged_triangles(raw, mesh);
  mesh.triangles = std::move(raw.triangles);
  mesh.triangle_surface = std::move(raw.triangle_tag);
  mesh.surfaces = number_tags(raw.surface_names, "surface", mesh.triangle_surface);
  drop_unused_vertices(mesh);
  validate(mesh, raw.path);
  return mesh;
}

}  // namespace tunica::mesh
