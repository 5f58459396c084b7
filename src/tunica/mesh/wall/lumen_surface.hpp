#pragma once
#include <array>
#include <string>
#include <vector>

#include "tunica/mesh/mesh.hpp"

namespace tunica::mesh::wall {

/// Lists of different lengths, one for each vertex, behind one another.
struct Lists {
  std::vector<int> begin;  ///< one more than there are vertices
  std::vector<int> items;
};

/// The surface of a lumen on which a wall is to grow, with numbers of its own.
struct LumenSurface {
  /// An edge at an opening.
  struct RimEdge {
    std::array<int, 2> vertices;  ///< in the order of its triangle
    int cap;                      ///< surface of the mesh beyond it
  };

  std::vector<int> mesh_vertex;  ///< ascending, so that the order of numbers is that of the mesh
  std::vector<Vec3> x;
  std::vector<std::array<int, 3>> triangles;  ///< normals away from the lumen
  std::vector<int> mesh_triangle;
  Lists triangles_of;   ///< of a vertex
  Lists neighbours_of;  ///< along edges
  std::vector<RimEdge> rim;
  std::vector<std::vector<Vec3>> planes_of;  ///< of a vertex: unit normals of the caps it touches
  std::vector<std::string> bent_caps;        ///< surfaces that are not flat

  int vertices() const { return static_cast<int>(x.size()); }
  Vec3 area_vector(int triangle) const;  ///< normal, as long as the area
  Vec3 normal(int triangle) const;
};

/// The triangles of these surfaces. Throws Error if one is unknown, lies within the mesh, or if
/// more than two triangles meet in an edge. A flat cap has one plane; one that is not flat has
/// the planes of its triangles, and its wall ends are as bent as it is.
LumenSurface lumen_surface(const Mesh& mesh, const std::vector<std::string>& surfaces);

}  // namespace tunica::mesh::wall
