#pragma once
#include <string>
#include <vector>

#include "tunica/mesh/mesh.hpp"

namespace tunica::mesh {

/// Contents and quality of a mesh. Lengths in the user's unit.
struct Info {
  struct Region {
    std::string name;
    int tets, vertices;
    double volume;
    double worst_quality, mean_quality;
  };
  struct Surface {
    std::string name;
    int triangles, vertices;
    double area;
    std::vector<std::string> neighbours;  ///< regions on its sides, in their order
  };
  /// Two regions that share faces.
  struct Contact {
    std::string first, second;
    int faces;         ///< shared
    int tagged_faces;  ///< of them, on a surface
  };

  int vertices, edges, faces, tets, triangles;
  int pieces;         ///< connected through faces
  int twin_vertices;  ///< vertices at the place of another one: a seam that does not conform
  double shortest_edge, longest_edge;
  double worst_quality, mean_quality;
  Vec3 worst_place;  ///< centre of gravity of the worst tetrahedron
  Vec3 low, high;    ///< bounding box
  std::vector<Region> regions;
  std::vector<Surface> surfaces;
  std::vector<Contact> contacts;
  std::vector<std::string> tet_vectors;  ///< names of the vectors on the tetrahedra

  /// Vertices − edges + faces − tetrahedra: 1 for a ball or a solid cylinder, 0 for a ring.
  int euler() const { return vertices - edges + faces - tets; }
};

Info inspect(const Mesh& mesh);

/// Mean-ratio quality 12 (3V)^(2/3) / Σ l² of a tetrahedron: 1 if regular, 0 if flat.
double quality(const Mesh& mesh, int tet);
/// Quality of a tetrahedron by its corners.
double quality(const std::array<Vec3, 4>& x);
/// The least of the six angles between faces of a tetrahedron [degrees].
double least_dihedral_angle(const std::array<Vec3, 4>& x);

/// Several lines of text.
std::string to_text(const Info& info);

}  // namespace tunica::mesh
