#pragma once
#include <string>
#include <vector>

#include "tunica/mesh/mesh.hpp"
#include "tunica/mesh/wall/thickness.hpp"

namespace tunica::mesh::wall {

/// A wall around a lumen.
struct Options {
  std::vector<std::string> surfaces{"lumen_wall"};  ///< of the lumen, on which it grows
  std::vector<Layer> layers{{"media", 0.26, 0}, {"adventitia", 0.13, 0}};
  Thickness thickness;
  std::string interface = "interface";  ///< new name of these surfaces
};

/// Report of a grown wall. Lengths in the user's unit.
struct Report {
  struct LayerReport {
    std::string name;
    int elements;  ///< through it
    int tets;
    double least, mean, most;             ///< thickness: distance of vertices from the lumen
    double mean_flatness, most_flatness;  ///< width of triangles over height of elements
    double flat_part;                     ///< of the elements: those flatter than 1 : 10
    double least_angle;                   ///< between two faces of an element, degrees
    double worst_quality;
  };
  /// Vertices beside one another whose thickness is less than wanted.
  struct Limited {
    int vertices;
    double least_thickness, wanted;  ///< of the whole wall, where least is left
    Vec3 place;                      ///< of it, on the lumen
    bool is_dense;  ///< since another part of the wall is close; otherwise it folds
  };

  std::vector<LayerReport> layers;
  double mean_width;  ///< of the lumen's triangles: root of twice the area
  double least_angle;
  Vec3 least_angle_place;
  double least_thickness;        ///< of the whole wall
  int surface_vertices;          ///< of the lumen, where the wall grows
  int limited_vertices;          ///< with less than 95 % of the thickness wanted
  std::vector<Limited> limited;  ///< places, the most limited one first
  std::vector<std::string> bent_caps;
};

struct Grown {
  Mesh mesh;
  Report report;
};

/// The lumen with a wall of prisms, cut into tetrahedra, around it.
///
/// Each vertex of the surfaces is carried along a smooth normal (vertex_normals.hpp), at openings
/// in the plane of the cap, as far as thickness.hpp says and limit.hpp permits. Vertices,
/// tetrahedra and triangles of the lumen keep their numbers; those of the wall follow. Regions of
/// the wall have the layers' names. Surfaces: interface, outer, wall_CAP around each cap, and
/// between layers "layer" if there are two, otherwise their names, "intima-media". Throws Error if
/// a name is taken or if no valid wall exists. The result passes validate() and check_interface().
Grown grow(const Mesh& lumen, const Options& wanted);

/// Several lines of text.
std::string to_text(const Report& report);

}  // namespace tunica::mesh::wall
