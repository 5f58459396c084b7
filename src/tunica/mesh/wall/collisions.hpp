#pragma once
#include <array>
#include <vector>

#include "tunica/mesh/wall/plan.hpp"

namespace tunica::mesh::wall {

using Corners = std::array<Vec3, 3>;

/// Limits the thickness where the wall would grow into another part of the lumen's surface: along
/// the ray from each vertex both walls together take at most four fifths of what is free.
void keep_clear_of_opposite(Plan& plan);

/// Triangles of the surface whose outer triangles cross another one, or an obstacle, if the wall
/// were a tenth thicker than planned. Triangles with a common vertex are not compared: their
/// elements show whether they fold. By a tree of boxes, O(n log n).
std::vector<int> crossing_triangles(const Plan& plan, const std::vector<Corners>& obstacles);

}  // namespace tunica::mesh::wall
