#include <algorithm>

#include "tunica/base/error.hpp"
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

enum class Field { other, fluid, wall };

std::vector<Field> region_fields(const Mesh& mesh, const std::vector<std::string>& fluid,
                                 const std::vector<std::string>& wall) {
  std::vector<Field> fields(mesh.regions.size(), Field::other);
  for (const std::string& name : fluid) fields[region_index(mesh, name)] = Field::fluid;
  for (const std::string& name : wall) {
    Field& field = fields[region_index(mesh, name)];
    TUNICA_CHECK(field != Field::fluid,
                 "region \"" + name + "\" is both fluid and wall, expected one of them");
    field = Field::wall;
  }
  return fields;
}

/// The triangles of the named surfaces, checked one by one.
class Interface {
public:
  Interface(const Mesh& mesh, std::vector<Field> fields, const std::vector<std::string>& surfaces)
      : mesh_(mesh), fields_(std::move(fields)), names_(surfaces), faces_(faces(mesh)) {
    std::vector<bool> is_interface(mesh.surfaces.size(), false);
    for (const std::string& name : surfaces) is_interface[surface_index(mesh, name)] = true;
    covered_.assign(faces_.size(), false);
    for (std::size_t i = 0; i < mesh.triangles.size(); ++i)
      if (is_interface[mesh.triangle_surface[i]]) triangles_.push_back(static_cast<int>(i));
  }

  /// Every triangle has a fluid and a wall tetrahedron.
  void check_neighbours() {
    int alone = 0, first = -1;
    for (const int i : triangles_) {
      const Face* face = find_face(faces_, mesh_.triangles[i]);
      TUNICA_CHECK(face, place(i) + " is not a face of any tetrahedron");
      covered_[face - faces_.data()] = true;
      if (face->is_boundary()) {
        if (alone++ == 0) first = i;
        continue;
      }
      const Field a = field(face->tets[0]), b = field(face->tets[1]);
      TUNICA_CHECK(a != b && a != Field::other && b != Field::other,
                   place(i) + " lies between regions \"" + region(face->tets[0]) + "\" and \"" +
                       region(face->tets[1]) + "\", expected one of the fluid and one of the wall");
    }
    if (alone > 0) fail_nonconforming(first, alone);
  }

  /// Every face between fluid and wall is one of the triangles.
  void check_complete() const {
    for (const Face& face : faces_) {
      if (face.is_boundary() || covered_[&face - faces_.data()]) continue;
      const Field a = field(face.tets[0]), b = field(face.tets[1]);
      TUNICA_CHECK(a == b || a == Field::other || b == Field::other,
                   "the face at " + show(centre(mesh_, face.vertices)) + " between regions \"" +
                       region(face.tets[0]) + "\" and \"" + region(face.tets[1]) +
                       "\" is not on an interface surface (" + params::quoted(names_) +
                       "). Tag it, or name its surface.");
    }
  }

  /// Fluid and wall meet nowhere else.
  void check_vertices() const {
    std::vector<bool> in_fluid(mesh_.vertices.size()), in_wall(in_fluid), on_interface(in_fluid);
    for (std::size_t t = 0; t < mesh_.tets.size(); ++t)
      for (const int v : mesh_.tets[t]) {
        if (field(static_cast<int>(t)) == Field::fluid) in_fluid[v] = true;
        if (field(static_cast<int>(t)) == Field::wall) in_wall[v] = true;
      }
    for (const int i : triangles_)
      for (const int v : mesh_.triangles[i]) on_interface[v] = true;
    for (std::size_t v = 0; v < mesh_.vertices.size(); ++v)
      TUNICA_CHECK(!in_fluid[v] || !in_wall[v] || on_interface[v],
                   "vertex " + std::to_string(v) + " at " + show(mesh_.vertices[v]) +
                       " is shared by fluid and wall but not on the interface: they touch in a "
                       "point or an edge only. Change the geometry there.");
  }

private:
  Field field(int tet) const { return fields_[mesh_.tet_region[tet]]; }
  const std::string& region(int tet) const { return mesh_.regions[mesh_.tet_region[tet]].name; }
  std::string place(int triangle) const {
    return "interface \"" + mesh_.surfaces[mesh_.triangle_surface[triangle]].name +
           "\": the triangle at " + show(centre(mesh_, mesh_.triangles[triangle]));
  }
  [[noreturn]] void fail_nonconforming(int triangle, int count) const {
    const int tet = find_face(faces_, mesh_.triangles[triangle])->tets[0];
    throw Error(place(triangle) + " has a tetrahedron of region \"" + region(tet) +
                "\" on one side and nothing on the other (" + std::to_string(count) + " of " +
                std::to_string(triangles_.size()) +
                " triangles). The interface does not conform: fluid and wall must share its "
                "vertices and triangles. Merge duplicate vertices, or mesh both together.");
  }

  const Mesh& mesh_;
  std::vector<Field> fields_;
  const std::vector<std::string>& names_;
  std::vector<Face> faces_;
  std::vector<bool> covered_;   ///< per face: one of the triangles
  std::vector<int> triangles_;  ///< of the interface surfaces
};

}  // namespace

int region_index(const Mesh& mesh, const std::string& name) {
  return tag_index(mesh.regions, "region", name);
}

int surface_index(const Mesh& mesh, const std::string& name) {
  return tag_index(mesh.surfaces, "surface", name);
}

void check_interface(const Mesh& mesh, const std::vector<std::string>& fluid,
                     const std::vector<std::string>& wall,
                     const std::vector<std::string>& interface) {
  Interface check(mesh, region_fields(mesh, fluid, wall), interface);
  check.check_neighbours();
  check.check_complete();
  check.check_vertices();
}

}  // namespace tunica::mesh
