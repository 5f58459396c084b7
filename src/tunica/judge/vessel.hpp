#pragma once
#include <optional>
#include <string>
#include <vector>

#include "tunica/mesh/distributed/share.hpp"

namespace tunica::judge {

/// Shapes of the elements of a field. Lengths in mm, angles in degrees.
struct ElementShapes {
  long long tets = 0;
  std::vector<long long>
      pieces;  ///< tetrahedra of those that are connected through faces, the most first
  double volume = 0.0;
  double worst_quality = 1.0, median_quality = 1.0;  ///< see mesh::quality()
  double least_angle = 180.0;                        ///< dihedral
  double volume_ratio = 1.0;                         ///< of the largest to the smallest
  double edge = 0.0;                                 ///< median of their lengths
  Vec3 worst_place{};                                ///< the middle of the worst
};

/// The part of a mesh that fills these regions (indices into mesh.regions). Medians are exact to
/// 1e-9 of the range of their values. Collective.
ElementShapes element_shapes(const mesh::Share& share, const std::vector<int>& regions);

/// Roles of the surfaces of a field in a vessel: names.
struct VesselSurfaces {
  std::vector<std::string>
      lumen_sides;  ///< of the fluid: where it passes along, no slip or interface
  std::vector<std::string> lumen_planes;  ///< of the fluid: planes of symmetry
  std::vector<std::string> wall_inside;   ///< of the wall: where the blood presses
  std::vector<std::string> wall_ends;     ///< of the wall: where it is held
};

/// A vessel as one would draw it. Zero, or nothing, is what cannot be told.
///
///   R = 2 V/A     V  volume of the lumen     A  area of its sides: exact for a tube of any length
///   L = V/(π R²)
///
/// Elements across are counted in edges, the fewest that lead from one side to the other.
struct Vessel {
  struct Opening {
    std::string surface;
    double area;             ///< mm²
    int elements_across;     ///< 0: it has no vertex but at its rim
    std::string wall_end{};  ///< the wall's surface around it
  };
  std::optional<ElementShapes> fluid, wall;
  std::vector<Opening> openings;        ///< surfaces of the fluid that are no sides
  double radius = 0.0, length = 0.0;    ///< of the lumen [mm]
  int elements_across_lumen = 0;        ///< the fewest of the openings
  double thickness = 0.0;               ///< of the wall, of its volume [mm]
  int elements_across_wall = 0;         ///< the median
  std::vector<double> region_shares{};  ///< of each region of the wall in its volume
};

/// fluid, wall: regions of the fields, in the case's order; empty where there is none. The same on
/// all ranks. Collective.
Vessel vessel_of(const mesh::Share& share, const std::vector<int>& fluid,
                 const std::vector<int>& wall, const VesselSurfaces& surfaces);

}  // namespace tunica::judge
