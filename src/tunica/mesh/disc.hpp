#pragma once
#include <array>
#include <vector>

#include "tunica/mesh/tube.hpp"

namespace tunica::mesh {

/// The cross-section of a tube: triangles and tagged edges in the plane.
struct Disc {
  struct Vertex {
    double x, y;
    bool is_odd;  ///< colour of the checkerboard; grid lines join different colours
  };
  struct Triangle {
    std::array<int, 3> vertices;
    int region;
  };
  struct Edge {
    std::array<int, 2> vertices;
    int surface;
  };
  std::vector<Vertex> vertices;
  std::vector<Triangle> triangles;
  std::vector<Edge> edges;  ///< of the surfaces that run along the tube
};

/// Numbers of the tags in tube.hpp.
enum TubeRegion { fluid_id = 1, media_id = 2, adventitia_id = 3 };
enum TubeSurface {
  inlet_id = 11,
  outlet_id,
  interface_id,
  struct_in_id,
  struct_out_id,
  outer_id,
  layer_id
};

Disc make_disc(const Tube& tube);

/// Positions 0 .. 1 of n cells whose sizes form a geometric sequence; last over first = grading.
std::vector<double> graded(int n, double grading);

}  // namespace tunica::mesh
