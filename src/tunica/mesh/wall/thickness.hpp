#pragma once
#include <optional>
#include <string>
#include <vector>

#include "tunica/mesh/wall/lumen_surface.hpp"

namespace tunica::mesh::wall {

/// A layer of the wall, from the lumen outwards.
struct Layer {
  std::string name;
  double thickness;  ///< mm; a share where the thickness of the wall is given otherwise
  int elements;      ///< through it; 0: grow() chooses
};

/// How thick the whole wall is. At most one is given; without any the layers say it.
struct Thickness {
  std::optional<double> uniform;   ///< mm
  std::optional<double> fraction;  ///< of the local radius of the lumen
  std::string file;                ///< thickness at points
};

/// "media=0.26:2,adventitia=0.13:1". Without ":2" elements is 0. Throws Error.
std::vector<Layer> layers_from_text(const std::string& text);

/// The wall's thickness wanted at each vertex. Throws Error if it is not positive everywhere.
///
/// A file is text with four numbers "x y z thickness" in a line (lines with # are comments), or
/// HDF5 with /points (n × 3) and /thickness (n), for instance the surface's vertices. Between its
/// points it is the mean of the four nearest, weighted by 1/distance².
std::vector<double> wall_thickness(const LumenSurface& surface, const std::vector<Layer>& layers,
                                   const Thickness& rule);

}  // namespace tunica::mesh::wall
