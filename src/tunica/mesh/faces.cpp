#include "tunica/mesh/faces.hpp"

#include <algorithm>
#include <tuple>

#include "tunica/base/error.hpp"
#include "tunica/mesh/text.hpp"

namespace tunica::mesh {
namespace {

/// One side of a face: the tetrahedron there, and whether sorting its outward vertices took
/// an even permutation. The two sides of a face differ in that.
struct Side {
  std::array<int, 3> vertices;
  int tet;
  bool is_even;
};

Side make_side(std::array<int, 3> v, int tet) {
  bool is_even = true;
  const auto order = [&](int i, int j) {
    if (v[i] <= v[j]) return;
    std::swap(v[i], v[j]);
    is_even = !is_even;
  };
  order(0, 1);
  order(1, 2);
  order(0, 1);
  return {v, tet, is_even};
}

std::vector<Side> sorted_sides(const Mesh& mesh) {
  std::vector<Side> sides;
  sides.reserve(4 * mesh.tets.size());
  for (std::size_t t = 0; t < mesh.tets.size(); ++t) {
    const auto& tet = mesh.tets[t];
    for (const auto& f : tet_faces)
      sides.push_back(make_side({tet[f[0]], tet[f[1]], tet[f[2]]}, static_cast<int>(t)));
  }
  std::sort(sides.begin(), sides.end(), [](const Side& a, const Side& b) {
    return std::tie(a.vertices, a.tet) < std::tie(b.vertices, b.tet);
  });
  return sides;
}

}  // namespace

std::vector<Face> faces(const Mesh& mesh, const std::string& name) {
  const std::vector<Side> sides = sorted_sides(mesh);
  std::vector<Face> result;
  result.reserve(sides.size() / 2 + 1);
  for (const Side& side : sides) {
    if (result.empty() || result.back().vertices != side.vertices) {
      result.push_back({side.vertices, {side.tet, -1}});
      continue;
    }
    Face& face = result.back();
    const auto where = [&] { return " at " + show(centre(mesh, face.vertices)); };
    TUNICA_CHECK(face.is_boundary(), name + ": the face" + where() + " belongs to tetrahedra " +
                                         std::to_string(face.tets[0]) + ", " +
                                         std::to_string(face.tets[1]) + " and " +
                                         std::to_string(side.tet) +
                                         ", expected at most two. Remove duplicate elements.");
    TUNICA_CHECK((&side - 1)->is_even != side.is_even,
                 name + ": tetrahedra " + std::to_string(face.tets[0]) + " and " +
                     std::to_string(side.tet) + " lie on the same side of their common face" +
                     where() + ". The mesh overlaps itself; make it anew.");
    face.tets[1] = side.tet;
  }
  return result;
}

const Face* find_face(const std::vector<Face>& sorted_faces, std::array<int, 3> vertices) {
  std::sort(vertices.begin(), vertices.end());
  const auto found =
      std::lower_bound(sorted_faces.begin(), sorted_faces.end(), vertices,
                       [](const Face& f, const std::array<int, 3>& v) { return f.vertices < v; });
  return found != sorted_faces.end() && found->vertices == vertices ? &*found : nullptr;
}

std::array<Vec3, 4> corners(const Mesh& mesh, int t) {
  const auto& tet = mesh.tets[t];
  return {mesh.vertices[tet[0]], mesh.vertices[tet[1]], mesh.vertices[tet[2]],
          mesh.vertices[tet[3]]};
}

double volume(const Mesh& mesh, int t) {
  const auto x = corners(mesh, t);
  return signed_volume(x[0], x[1], x[2], x[3]);
}

Vec3 centre(const Mesh& mesh, const std::array<int, 3>& triangle) {
  return (1.0 / 3.0) *
         (mesh.vertices[triangle[0]] + mesh.vertices[triangle[1]] + mesh.vertices[triangle[2]]);
}

double area(const Mesh& mesh, const std::array<int, 3>& triangle) {
  const Vec3& a = mesh.vertices[triangle[0]];
  return 0.5 * norm(cross(mesh.vertices[triangle[1]] - a, mesh.vertices[triangle[2]] - a));
}

}  // namespace tunica::mesh
