#pragma once
#include "tunica/mesh/mesh.hpp"

namespace tunica::mesh {

/// A block of cells along the axes, with one corner in the origin. Each cell becomes six tetrahedra
/// about the diagonal from its lowest to its highest corner (Kuhn): all faces match, and all
/// vertices inside have the same neighbours.
///
/// Region: 1 block. Surfaces: 1 x_low, 2 x_high, 3 y_low, 4 y_high, 5 z_low, 6 z_high, 7 patch:
/// that part of the top z = size[2] which is nearest to the corner at x = y = 0.
struct Block {
  Vec3 size{1.0, 1.0, 1.0};           ///< mm
  std::array<int, 3> cells{8, 8, 8};  ///< along each axis
  std::array<int, 2> patch{0, 0};     ///< cells of the patch along x and y; 0 in both: no patch
};

/// Throws Error if an option is out of range. The mesh passes validate().
Mesh make_block(const Block& block);

}  // namespace tunica::mesh
