#pragma once
#include <array>
#include <map>
#include <string>
#include <vector>

#include "tunica/mesh/mesh.hpp"

namespace tunica::mesh {

/// What a text format holds, with the numbers of the file: the common end of its readers.
/// Tag 0 means that the file gives none.
struct RawMesh {
  std::string path;
  std::vector<Vec3> vertices;
  std::vector<std::array<int, 4>> tets;  ///< indices into vertices
  std::vector<int> tet_tag;
  std::vector<long long> tet_number;  ///< in the file, for messages
  std::vector<std::array<int, 3>> triangles;
  std::vector<int> triangle_tag;
  std::vector<TetVectors> tet_vectors;
  std::map<int, std::string> region_names;
  std::map<int, std::string> surface_names;
};

/// Turns it into a valid mesh:
/// - if all tetrahedra are negative they are flipped; single ones are an Error that names
///   the element's number in the file;
/// - triangles without tag are dropped unless they lie on the boundary;
/// - vertices of no element (centres of arcs) are dropped;
/// - tags that are used become regions and surfaces, in the order of their numbers; a tag
///   without name is called "region-7" or "surface-11".
Mesh finish(RawMesh raw);

/// Replaces numbers by positions among those that are in use, ascending, and returns these as tags;
/// one without name is called kind-number.
std::vector<Tag> number_tags(std::map<int, std::string> names, const std::string& kind,
                             std::vector<int>& numbers);

}  // namespace tunica::mesh
