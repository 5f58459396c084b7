#include <algorithm>

#include "tunica/base/error.hpp"
#include "tunica/mesh/checks.hpp"
#include "tunica/mesh/faces.hpp"
#include "tunica/mesh/text.hpp"
#include "tunica/mesh/validate.hpp"
#include "tunica/params/nearest.hpp"

namespace tunica::mesh {
namespace {

std::vector<std::string> names_of(const std::vector<Tag>& tags) {
  std::vector<std::string> names;
  for (const Tag& tag : tags) names.push_back(tag.name);
  return names;
}

int tag_index(const std::vector<Tag>& tags, const std::string& kind, const std::string& name) {
  const auto found =
      std::find_if(tags.begin(), tags.end(), [&](const Tag& tag) { return tag.name == name; });
  TUNICA_CHECK(found != tags.end(), "the mesh has no " + kind + " \"" + name + "\". " +
                                        params::did_you_mean(name, names_of(tags)));
  return static_cast<int>(found - tags.begin());
}

using Triple = std::array<int, 3>;

Triple sorted(Triple t) {
  std::sort(t.begin(), t.end());
  return t;
}

}  // namespace

InterfaceCheck::InterfaceCheck(const Excerpt& part,
                               const std::vector<std::array<int, 2>>& regions_beside,
                               const std::vector<std::string>& fluid,
                               const std::vector<std::string>& wall,
                               const std::vector<std::string>& interface)
    : part_(part), beside_(regions_beside), names_(interface),
      fields_(part.mesh.regions.size(), Field::other), is_interface_(part.mesh.surfaces.size()) {
  const Mesh& mesh = part.mesh;
  for (const std::string& name : fluid) fields_[region_index(mesh, name)] = Field::fluid;
  for (const std::string& name : wall) {
    Field& its_field = fields_[region_index(mesh, name)];
    TUNICA_CHECK(its_field != Field::fluid,
                 "region \"" + name + "\" is both fluid and wall, expected one of them");
    its_field = Field::wall;
  }
  for (const std::string& name : interface) is_interface_[surface_index(mesh, name)] = 1;
  for (std::size_t i = 0; i < mesh.triangles.size(); ++i) {
    if (!is_interface_[mesh.triangle_surface[i]] || !part.has(mesh.triangles[i])) continue;
    triangles_.push_back(static_cast<int>(i));
    if (beside_[i][1] >= 0) continue;
    if (alone_++ == 0) first_alone_ = static_cast<int>(i);
  }
}

std::string InterfaceCheck::place(int triangle) const {
  const Mesh& mesh = part_.mesh;
  return "interface \"" + mesh.surfaces[mesh.triangle_surface[triangle]].name +
         "\": the triangle at " + show(centre(mesh, mesh.triangles[triangle]));
}

std::string InterfaceCheck::nonconforming(long long count, long long of) const {
  return place(first_alone_) + " has a tetrahedron of region \"" +
         region(beside_[first_alone_][0]) + "\" on one side and nothing on the other (" +
         std::to_string(count) + " of " + std::to_string(of) +
         " triangles). The interface does not conform: fluid and wall must share its vertices and "
         "triangles. Merge duplicate vertices, or mesh both together.";
}

void InterfaceCheck::check_neighbours() const {
  for (const int i : triangles_) {
    const auto& [first, second] = beside_[i];
    if (second < 0) continue;
    const Field a = field(first), b = field(second);
    TUNICA_CHECK(a != b && a != Field::other && b != Field::other,
                 place(i) + " lies between regions \"" + region(first) + "\" and \"" +
                     region(second) + "\", expected one of the fluid and one of the wall");
  }
}

void InterfaceCheck::check_elsewhere() const {
  check_complete();
  check_vertices();
}

/// Every face between fluid and wall is one of the triangles.
void InterfaceCheck::check_complete() const {
  const Mesh& mesh = part_.mesh;
  std::vector<Triple> covered;
  for (const int i : triangles_) covered.push_back(sorted(mesh.triangles[i]));
  std::sort(covered.begin(), covered.end());
  for_each_face(part_, "mesh", [&](const Face& face) {
    if (face.is_boundary()) return;
    const int first = mesh.tet_region[face.tets[0]], second = mesh.tet_region[face.tets[1]];
    const Field a = field(first), b = field(second);
    if (a == b || a == Field::other || b == Field::other) return;
    TUNICA_CHECK(std::binary_search(covered.begin(), covered.end(), face.vertices),
                 "the face at " + show(centre(mesh, face.vertices)) + " between regions \"" +
                     region(first) + "\" and \"" + region(second) +
                     "\" is not on an interface surface (" + params::quoted(names_) +
                     "). Tag it, or name its surface.");
  });
}

/// Fluid and wall meet nowhere else.
void InterfaceCheck::check_vertices() const {
  const Mesh& mesh = part_.mesh;
  std::vector<bool> in_fluid(mesh.vertices.size()), in_wall(in_fluid), on_interface(in_fluid);
  for (std::size_t t = 0; t < mesh.tets.size(); ++t) {
    const Field its_field = field(mesh.tet_region[t]);
    for (const int v : mesh.tets[t]) {
      if (its_field == Field::fluid) in_fluid[v] = true;
      if (its_field == Field::wall) in_wall[v] = true;
    }
  }
  for (std::size_t i = 0; i < mesh.triangles.size(); ++i)
    if (is_interface_[mesh.triangle_surface[i]])
      for (const int v : mesh.triangles[i]) on_interface[v] = true;
  for (std::size_t v = 0; v < mesh.vertices.size(); ++v)
    TUNICA_CHECK(!part_.has(static_cast<int>(v)) || !in_fluid[v] || !in_wall[v] || on_interface[v],
                 "vertex " + part_.vertex(static_cast<int>(v)) + " at " + show(mesh.vertices[v]) +
                     " is shared by fluid and wall but not on the interface: they touch in a "
                     "point or an edge only. Change the geometry there.");
}

int region_index(const Mesh& mesh, const std::string& name) {
  return tag_index(mesh.regions, "region", name);
}

int surface_index(const Mesh& mesh, const std::string& name) {
  return tag_index(mesh.surfaces, "surface", name);
}

void check_interface(const Mesh& mesh, const std::vector<std::string>& fluid,
                     const std::vector<std::string>& wall,
                     const std::vector<std::string>& interface) {
  const Excerpt all(mesh);
  const std::vector<std::array<int, 2>> beside = regions_beside(mesh, covering(all, "mesh"));
  const InterfaceCheck check(all, beside, fluid, wall, interface);
  check.check_neighbours();
  if (check.alone() > 0) throw Error(check.nonconforming(check.alone(), check.triangles()));
  check.check_elsewhere();
}

}  // namespace tunica::mesh
