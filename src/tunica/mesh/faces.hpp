#pragma once
#include <array>
#include <functional>
#include <string>
#include <vector>

#include "tunica/mesh/excerpt.hpp"

namespace tunica::mesh {

/// Local vertices of the four faces of a tetrahedron, normals outward; face i is opposite
/// vertex i.
constexpr std::array<std::array<int, 3>, 4> tet_faces{{{1, 2, 3}, {0, 3, 2}, {0, 1, 3}, {0, 2, 1}}};
/// Local vertices of the six edges of a tetrahedron; edges i and 5 − i are opposite.
constexpr std::array<std::array<int, 2>, 6> tet_edges{
    {{0, 1}, {0, 2}, {0, 3}, {1, 2}, {1, 3}, {2, 3}}};

/// A triangle between two tetrahedra, or between one and the outside.
struct Face {
  std::array<int, 3> vertices;  ///< ascending
  std::array<int, 2> tets;      ///< ascending; the second is -1 on the boundary
  bool is_boundary() const { return tets[1] < 0; }
};

/// Visits every face of the excerpt once, sorted by vertices; takes room for few of them at a time.
/// Throws Error, beginning with name, if a face has three or more tetrahedra or two on the same
/// side.
void for_each_face(const Excerpt& part, const std::string& name,
                   const std::function<void(const Face&)>& visit);
/// Every face of the mesh once, sorted by vertices. Throws as for_each_face() does.
std::vector<Face> faces(const Mesh& mesh, const std::string& name = "mesh");

/// The face with these vertices in any order, or nullptr.
const Face* find_face(const std::vector<Face>& sorted_faces, std::array<int, 3> vertices);

/// The four corners of tetrahedron t.
std::array<Vec3, 4> corners(const Mesh& mesh, int t);
/// Signed volume of tetrahedron t.
double volume(const Mesh& mesh, int t);
/// Centre of gravity of a triangle.
Vec3 centre(const Mesh& mesh, const std::array<int, 3>& triangle);
/// Area of a triangle.
double area(const Mesh& mesh, const std::array<int, 3>& triangle);

}  // namespace tunica::mesh
