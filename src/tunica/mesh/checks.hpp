#pragma once
#include <string>
#include <vector>

#include "tunica/mesh/excerpt.hpp"

/// The steps of validate(), each for what one rank knows. They throw Error that begins with name.
namespace tunica::mesh {

/// Tags are unique and have names.
void check_tags(const Mesh& mesh, const std::string& name);

/// Where the rows of a rank begin in the whole mesh, and how many vertices that has.
struct Place {
  long long first_vertex = 0, first_tet = 0, first_triangle = 0;
  long long vertices = 0;
};

/// Lengths of the arrays, numbers of vertices and tags in range, finite numbers. The vertices of
/// elements are those of the whole mesh.
void check_rows(const Mesh& rows, const Place& place, const std::string& name);

/// Every vertex belongs to a tetrahedron.
void check_use(const std::vector<char>& is_used, const std::vector<Vec3>& vertices, long long first,
               const std::string& name);

/// No inverted and no degenerate tetrahedron among those whose lowest vertex the rank answers for.
void check_shapes(const Excerpt& part, const std::string& name);

/// Coverage by triangles of the faces that the rank is responsible for.
struct Covering {
  std::vector<std::array<int, 2>> tets;  ///< beside each triangle; -1 for none, or not answered for
  long long bare = 0;                    ///< boundary faces without triangle
  std::string first_bare;                ///< behind their number in a message
};

/// Throws where a triangle is no face or covers one twice.
Covering covering(const Excerpt& part, const std::string& name);
/// That so many boundary faces are bare.
std::string bare_faces(long long count, const std::string& first, const std::string& name);

/// The regions beside each triangle; -1 for none.
std::vector<std::array<int, 2>> regions_beside(const Mesh& mesh, const Covering& covering);

}  // namespace tunica::mesh
