#include "tunica/mesh/validate.hpp"

#include <algorithm>
#include <cmath>
#include <set>

#include "tunica/base/error.hpp"
#include "tunica/mesh/faces.hpp"
#include "tunica/mesh/text.hpp"

namespace tunica::mesh {
namespace {

std::string number(std::size_t n) { return std::to_string(n); }

/// Below this volume, as part of the cube of the longest edge, a tetrahedron is flat.
constexpr double flat = 1e-12;

void check_tags(const std::vector<Tag>& tags, const std::string& kind, const std::string& name) {
  std::set<int> ids;
  std::set<std::string> names;
  for (const Tag& tag : tags) {
    TUNICA_CHECK(tag.id >= 0, name + ": a " + kind + " has the number " + std::to_string(tag.id) +
                                  ", expected 0 or more");
    TUNICA_CHECK(ids.insert(tag.id).second,
                 name + ": two " + kind + "s have the number " + std::to_string(tag.id));
    TUNICA_CHECK(!tag.name.empty(),
                 name + ": " + kind + " " + std::to_string(tag.id) + " has an empty name");
    TUNICA_CHECK(names.insert(tag.name).second,
                 name + ": two " + kind + "s are named \"" + tag.name + "\"");
  }
}

void check_tet_vectors(const Mesh& mesh, const std::string& name) {
  std::set<std::string> names;
  for (const TetVectors& vectors : mesh.tet_vectors) {
    TUNICA_CHECK(
        !vectors.name.empty() && vectors.name.find_first_of("\"<>&\n") == std::string::npos,
        name + ": vectors on tetrahedra are named \"" + vectors.name +
            "\", expected a name without quotation marks, <, > and &");
    TUNICA_CHECK(names.insert(vectors.name).second,
                 name + ": two sets of vectors on tetrahedra are named \"" + vectors.name + "\"");
    TUNICA_CHECK(vectors.values.size() == mesh.tets.size(),
                 name + ": \"" + vectors.name + "\" has " + number(vectors.values.size()) +
                     " vectors, expected one for each of " + number(mesh.tets.size()) +
                     " tetrahedra");
    for (std::size_t t = 0; t < vectors.values.size(); ++t)
      TUNICA_CHECK(std::isfinite(norm(vectors.values[t])),
                   name + ": \"" + vectors.name + "\" on tetrahedron " + number(t) + " is " +
                       show(vectors.values[t]) + ", expected finite numbers");
  }
}

/// Vertices in range and different, tag in range. what: "tetrahedron" or "triangle".
template <std::size_t N>
void check_elements(const std::vector<std::array<int, N>>& elements, const std::vector<int>& tags,
                    std::size_t vertices, std::size_t tag_count, const std::string& what) {
  TUNICA_CHECK(
      elements.size() == tags.size(),
      what + ": " + number(elements.size()) + " elements but " + number(tags.size()) + " tags");
  for (std::size_t e = 0; e < elements.size(); ++e) {
    const auto place = [&] { return what + " " + number(e); };
    for (std::size_t i = 0; i < N; ++i) {
      const int v = elements[e][i];
      TUNICA_CHECK(
          v >= 0 && static_cast<std::size_t>(v) < vertices,
          place() + " has vertex " + std::to_string(v) + ", expected 0.." + number(vertices - 1));
      for (std::size_t j = 0; j < i; ++j)
        TUNICA_CHECK(elements[e][j] != v,
                     place() + " has vertex " + std::to_string(v) + " more than once");
    }
    TUNICA_CHECK(tags[e] >= 0 && static_cast<std::size_t>(tags[e]) < tag_count,
                 place() + " has tag index " + std::to_string(tags[e]) + ", expected 0.." +
                     number(tag_count) + " (exclusive)");
  }
}

void check_shapes(const Mesh& mesh, const std::string& name) {
  for (std::size_t t = 0; t < mesh.tets.size(); ++t) {
    const auto x = corners(mesh, static_cast<int>(t));
    double h = 0.0;
    for (const auto& e : tet_edges) h = std::max(h, norm(x[e[1]] - x[e[0]]));
    const double V = volume(mesh, static_cast<int>(t));
    const auto text = [&](const std::string& kind) {
      return name + ": " + kind + " element: tetrahedron " + number(t) + " of region \"" +
             mesh.regions[mesh.tet_region[t]].name + "\" at " + show(x[0]) + " has volume " +
             show(V) + ", expected a positive one";
    };
    TUNICA_CHECK(V > -flat * h * h * h, text("inverted"));
    TUNICA_CHECK(V > flat * h * h * h, text("degenerate"));
  }
}

void check_vertices(const Mesh& mesh, const std::string& name) {
  std::vector<bool> is_used(mesh.vertices.size(), false);
  for (const auto& tet : mesh.tets)
    for (const int v : tet) is_used[v] = true;
  for (std::size_t v = 0; v < mesh.vertices.size(); ++v) {
    for (const double x : mesh.vertices[v])
      TUNICA_CHECK(std::isfinite(x), name + ": vertex " + number(v) +
                                         " has a coordinate that is not a finite number");
    TUNICA_CHECK(is_used[v], name + ": vertex " + number(v) + " at " + show(mesh.vertices[v]) +
                                 " belongs to no tetrahedron. Remove it from the file.");
  }
}

void check_triangles(const Mesh& mesh, const std::vector<Face>& all, const std::string& name) {
  std::vector<int> covering(all.size(), -1);
  for (std::size_t i = 0; i < mesh.triangles.size(); ++i) {
    const Face* face = find_face(all, mesh.triangles[i]);
    const auto place = [&] {
      return name + ": triangle " + number(i) + " of surface \"" +
             mesh.surfaces[mesh.triangle_surface[i]].name + "\" at " +
             show(centre(mesh, mesh.triangles[i]));
    };
    TUNICA_CHECK(face, place() + " is not a face of any tetrahedron");
    int& cover = covering[face - all.data()];
    TUNICA_CHECK(cover < 0, place() + " has the same vertices as triangle " +
                                std::to_string(cover) + " of surface \"" +
                                mesh.surfaces[mesh.triangle_surface[cover]].name +
                                "\". Each face belongs to one surface only.");
    cover = static_cast<int>(i);
  }
  const auto is_bare = [&](const Face& f) {
    return f.is_boundary() && covering[&f - all.data()] < 0;
  };
  const auto first = std::find_if(all.begin(), all.end(), is_bare);
  if (first == all.end()) return;
  TUNICA_CHECK(false, name + ": " + number(std::count_if(first, all.end(), is_bare)) +
                          " boundary faces belong to no surface; the first, at " +
                          show(centre(mesh, first->vertices)) + ", is a face of region \"" +
                          mesh.regions[mesh.tet_region[first->tets[0]]].name +
                          "\". Tag every outer face.");
}

}  // namespace

void validate(const Mesh& mesh, const std::string& name) {
  TUNICA_CHECK(!mesh.tets.empty(), name + ": the mesh has no tetrahedra");
  TUNICA_CHECK(!mesh.vertices.empty(), name + ": the mesh has no vertices");
  check_tags(mesh.regions, "region", name);
  check_tags(mesh.surfaces, "surface", name);
  check_elements(mesh.tets, mesh.tet_region, mesh.vertices.size(), mesh.regions.size(),
                 name + ": tetrahedron");
  check_elements(mesh.triangles, mesh.triangle_surface, mesh.vertices.size(), mesh.surfaces.size(),
                 name + ": triangle");
  check_tet_vectors(mesh, name);
  check_vertices(mesh, name);
  check_shapes(mesh, name);
  check_triangles(mesh, faces(mesh, name), name);
}

}  // namespace tunica::mesh
