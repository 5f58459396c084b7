#pragma once
#include "tunica/mesh/mesh.hpp"

namespace tunica::mesh {

/// A straight tube about the z axis, from z = 0 to z = length: lumen and wall of two layers.
///
/// Cross-section: a square grid of (around/4)² cells, bent to a disc and surrounded by
/// `rings` rings, gives the lumen; rings of quadrilaterals give the wall. It is extruded into
/// `axial` slices; every quadrilateral becomes two prisms, every prism three tetrahedra whose
/// diagonals follow a fixed order of the vertices, so that all faces match
/// (Dompierre, Labbé, Vallet, Camarero: How to subdivide pyramids, prisms and hexahedra into
/// tetrahedra, 1999). The result depends on the options only.
///
/// Regions: 1 fluid, 2 media, 3 adventitia. Surfaces: 11 inlet, 12 outlet, 13 interface (the
/// inner side of the wall, also if lumen or wall is missing), 14 struct_in, 15 struct_out,
/// 16 outer, 17 layer (between media and adventitia, if with_layer_surface).
struct Tube {
  double radius = 1.43;      ///< of the lumen, mm
  double media = 0.26;       ///< thickness, mm
  double adventitia = 0.13;  ///< thickness, mm
  double length = 18.0;      ///< mm

  int around = 12;            ///< divisions of the circumference, a multiple of 4
  int rings = 0;              ///< of the lumen, around the core
  int axial = 18;             ///< slices
  int media_layers = 2;       ///< 0: no media
  int adventitia_layers = 1;  ///< 0: no adventitia

  double ring_grading = 1.0;   ///< thickness of the outermost ring over that of the innermost
  double axial_grading = 1.0;  ///< length of the last slice over that of the first

  bool with_lumen = true;
  bool with_wall = true;
  bool with_layer_surface = true;
};

/// Throws Error if an option is out of range. The mesh passes validate().
Mesh make_tube(const Tube& tube);

}  // namespace tunica::mesh
