#pragma once
#include <vector>

#include "tunica/mesh/wall/lumen_surface.hpp"

namespace tunica::mesh::wall {

/// The lumen's radius as each vertex of its surface sees it: that of the largest ball that touches
/// the surface there from within and holds no other vertex.
///
/// In a round tube that is its radius, exactly at the vertices of one section; in a flat one half
/// the distance of the sides; at a fork it stays that of the nearer branch, where a ray might miss
/// all walls. Vertices seen at less than 30 degrees above the tangential plane do not stop the
/// ball: they are neighbours whose height is the roughness of the surface. The median over
/// neighbours and three rounds of averaging make the rest smooth. By a tree of boxes, O(n log n).
/// The ball: Ma, Bae, Choi: 3D medial axis point approximation using nearest neighbors, 2012.
std::vector<double> local_radius(const LumenSurface& surface);

}  // namespace tunica::mesh::wall
