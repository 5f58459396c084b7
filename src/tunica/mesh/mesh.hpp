#pragma once
#include <array>
#include <string>
#include <vector>

#include "tunica/base/tensor.hpp"

namespace tunica::mesh {

/// A named part of a mesh: a region (tetrahedra) or a surface (triangles).
struct Tag {
  int id;  ///< number in the file; unique among regions, and among surfaces
  std::string name;
};

/// A vector on each tetrahedron that came with the mesh, such as a direction of fibres.
struct TetVectors {
  std::string name;
  std::vector<Vec3> values;  ///< per tet; zero where the file gives none
};

/// A whole tetrahedral mesh of fluid and wall on one rank, for which the following holds. Lengths
/// in the user's unit (mm). A Slab and a Share use the arrays for their rows and for what a rank
/// has of a mesh: there numbers are those of the whole, or the rim is not covered by triangles.
///
/// Tetrahedra are positively oriented. Triangles cover every outer face and the interface
/// between fluid and wall; each belongs to exactly one surface. Further triangles between
/// tetrahedra are permitted (the boundary of media and adventitia). The order of a triangle's
/// vertices says nothing about its sides. Fluid and wall share the vertices of the interface.
/// validate.hpp checks all this.
struct Mesh {
  std::vector<Vec3> vertices;
  std::vector<std::array<int, 4>> tets;
  std::vector<int> tet_region;  ///< per tet: index into regions
  std::vector<std::array<int, 3>> triangles;
  std::vector<int> triangle_surface;  ///< per triangle: index into surfaces
  std::vector<Tag> regions;
  std::vector<Tag> surfaces;
  std::vector<TetVectors> tet_vectors;  ///< names are unique
};

}  // namespace tunica::mesh
