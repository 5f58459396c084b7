#include "tunica/mesh/validate.hpp"

#include <algorithm>
#include <cmath>
#include <set>

#include "tunica/base/error.hpp"
#include "tunica/mesh/checks.hpp"
#include "tunica/mesh/faces.hpp"
#include "tunica/mesh/text.hpp"

namespace tunica::mesh {
namespace {

std::string number(long long n) { return std::to_string(n); }

/// Below this volume, as part of the cube of the longest edge, a tetrahedron is flat.
constexpr double flat = 1e-12;

void check_unique(const std::vector<Tag>& tags, const std::string& kind, const std::string& name) {
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

void check_tet_vectors(const Mesh& mesh, long long first, const std::string& name) {
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
                   name + ": \"" + vectors.name + "\" on tetrahedron " +
                       number(first + static_cast<long long>(t)) + " is " +
                       show(vectors.values[t]) + ", expected finite numbers");
  }
}

/// Vertices in range and different, tag in range. what: "tetrahedron" or "triangle".
template <std::size_t N>
void check_elements(const std::vector<std::array<int, N>>& elements, const std::vector<int>& tags,
                    long long first, long long vertices, std::size_t tag_count,
                    const std::string& what) {
  TUNICA_CHECK(
      elements.size() == tags.size(),
      what + ": " + number(elements.size()) + " elements but " + number(tags.size()) + " tags");
  for (std::size_t e = 0; e < elements.size(); ++e) {
    const auto place = [&] { return what + " " + number(first + static_cast<long long>(e)); };
    for (std::size_t i = 0; i < N; ++i) {
      const int v = elements[e][i];
      TUNICA_CHECK(v >= 0 && v < vertices, place() + " has vertex " + std::to_string(v) +
                                               ", expected 0.." + number(vertices - 1));
      for (std::size_t j = 0; j < i; ++j)
        TUNICA_CHECK(elements[e][j] != v,
                     place() + " has vertex " + std::to_string(v) + " more than once");
    }
    TUNICA_CHECK(tags[e] >= 0 && static_cast<std::size_t>(tags[e]) < tag_count,
                 place() + " has tag index " + std::to_string(tags[e]) + ", expected 0.." +
                     number(tag_count) + " (exclusive)");
  }
}

}  // namespace

void check_tags(const Mesh& mesh, const std::string& name) {
  check_unique(mesh.regions, "region", name);
  check_unique(mesh.surfaces, "surface", name);
}

void check_rows(const Mesh& rows, const Place& place, const std::string& name) {
  check_elements(rows.tets, rows.tet_region, place.first_tet, place.vertices, rows.regions.size(),
                 name + ": tetrahedron");
  check_elements(rows.triangles, rows.triangle_surface, place.first_triangle, place.vertices,
                 rows.surfaces.size(), name + ": triangle");
  check_tet_vectors(rows, place.first_tet, name);
  for (std::size_t v = 0; v < rows.vertices.size(); ++v)
    for (const double x : rows.vertices[v])
      TUNICA_CHECK(std::isfinite(x), name + ": vertex " +
                                         number(place.first_vertex + static_cast<long long>(v)) +
                                         " has a coordinate that is not a finite number");
}

void check_use(const std::vector<char>& is_used, const std::vector<Vec3>& vertices, long long first,
               const std::string& name) {
  for (std::size_t v = 0; v < vertices.size(); ++v)
    TUNICA_CHECK(is_used[v], name + ": vertex " + number(first + static_cast<long long>(v)) +
                                 " at " + show(vertices[v]) +
                                 " belongs to no tetrahedron. Remove it from the file.");
}

void check_shapes(const Excerpt& part, const std::string& name) {
  const Mesh& mesh = part.mesh;
  for (int t = 0; t < static_cast<int>(mesh.tets.size()); ++t) {
    const auto& v = mesh.tets[t];
    if (!part.has(std::min({v[0], v[1], v[2], v[3]}))) continue;
    const auto x = corners(mesh, t);
    double h = 0.0;
    for (const auto& e : tet_edges) h = std::max(h, norm(x[e[1]] - x[e[0]]));
    const double V = volume(mesh, t);
    const auto text = [&](const std::string& kind) {
      return name + ": " + kind + " element: tetrahedron " + part.tet(t) + " of region \"" +
             mesh.regions[mesh.tet_region[t]].name + "\" at " + show(x[0]) + " has volume " +
             show(V) + ", expected a positive one";
    };
    TUNICA_CHECK(V > -flat * h * h * h, text("inverted"));
    TUNICA_CHECK(V > flat * h * h * h, text("degenerate"));
  }
}

namespace {

using Triple = std::array<int, 3>;

/// Triangles that the rank answers for, with ascending vertices, in their order.
std::vector<std::pair<Triple, int>> sorted_triangles(const Excerpt& part) {
  std::vector<std::pair<Triple, int>> sorted;
  for (std::size_t i = 0; i < part.mesh.triangles.size(); ++i) {
    if (!part.has(part.mesh.triangles[i])) continue;
    sorted.emplace_back(part.mesh.triangles[i], static_cast<int>(i));
    std::sort(sorted.back().first.begin(), sorted.back().first.end());
  }
  std::sort(sorted.begin(), sorted.end());
  return sorted;
}

}  // namespace

Covering covering(const Excerpt& part, const std::string& name) {
  const Mesh& mesh = part.mesh;
  const auto triangles = sorted_triangles(part);
  const auto surface_of = [&](int i) { return mesh.surfaces[mesh.triangle_surface[i]].name; };
  const auto place = [&](int i) {
    return name + ": triangle " + part.triangle(i) + " of surface \"" + surface_of(i) + "\" at " +
           show(centre(mesh, mesh.triangles[i]));
  };
  for (std::size_t k = 1; k < triangles.size(); ++k) {
    const int i = triangles[k].second, before = triangles[k - 1].second;
    TUNICA_CHECK(triangles[k].first != triangles[k - 1].first,
                 place(i) + " has the same vertices as triangle " + part.triangle(before) +
                     " of surface \"" + surface_of(before) +
                     "\". Each face belongs to one surface only.");
  }
  Covering found;
  found.tets.assign(mesh.triangles.size(), {-1, -1});
  auto next = triangles.begin();  // both go through the faces in the same order
  const auto check_lost = [&](bool is_lost) {
    TUNICA_CHECK(!is_lost, place(next->second) + " is not a face of any tetrahedron");
  };
  for_each_face(part, name, [&](const Face& face) {
    check_lost(next != triangles.end() && next->first < face.vertices);
    if (next != triangles.end() && next->first == face.vertices) {
      found.tets[(next++)->second] = face.tets;
    } else if (face.is_boundary() && found.bare++ == 0) {
      found.first_bare = "at " + show(centre(mesh, face.vertices)) + ", is a face of region \"" +
                         mesh.regions[mesh.tet_region[face.tets[0]]].name + "\"";
    }
  });
  check_lost(next != triangles.end());
  return found;
}

std::string bare_faces(long long count, const std::string& first, const std::string& name) {
  return name + ": " + number(count) + " boundary faces belong to no surface; the first, " + first +
         ". Tag every outer face.";
}

std::vector<std::array<int, 2>> regions_beside(const Mesh& mesh, const Covering& covering) {
  std::vector<std::array<int, 2>> regions;
  regions.reserve(covering.tets.size());
  for (const auto& [a, b] : covering.tets)
    regions.push_back({a < 0 ? -1 : mesh.tet_region[a], b < 0 ? -1 : mesh.tet_region[b]});
  return regions;
}

void validate(const Mesh& mesh, const std::string& name) {
  TUNICA_CHECK(!mesh.tets.empty(), name + ": the mesh has no tetrahedra");
  TUNICA_CHECK(!mesh.vertices.empty(), name + ": the mesh has no vertices");
  check_tags(mesh, name);
  Place place;
  place.vertices = static_cast<long long>(mesh.vertices.size());
  check_rows(mesh, place, name);
  std::vector<char> is_used(mesh.vertices.size(), 0);
  for (const auto& tet : mesh.tets)
    for (const int v : tet) is_used[v] = 1;
  check_use(is_used, mesh.vertices, 0, name);
  const Excerpt all(mesh);
  check_shapes(all, name);
  const Covering found = covering(all, name);
  if (found.bare > 0) throw Error(bare_faces(found.bare, found.first_bare, name));
}

}  // namespace tunica::mesh
