#pragma once
#include <vector>

#include "tunica/mesh/wall/collisions.hpp"
#include "tunica/mesh/wall/plan.hpp"

namespace tunica::mesh::wall {

/// Makes the plan one without inverted elements, and whose outer side crosses neither itself nor
/// an obstacle (the caps of the lumen).
///
/// 1. Where an element has less than half the volume that an even prism would give it, the
///    directions of its vertices are turned towards those of their neighbours, some rounds long.
/// 2. Where other parts are in the way of a vertex its thickness is limited at once.
/// 3. Where an element still has less than a sixth, directions are turned again, and after some
///    rounds the thickness is taken back there by a seventh.
/// 4. The same where outer triangles cross.
/// 5. Each limit spreads: the thickness grows from it by at most three tenths of the distance.
/// 3 to 5 are repeated. Throws Error that names the place where less than a twentieth would be
/// left.
void limit(Plan& plan, const std::vector<Corners>& obstacles);

/// The volume of the worst tetrahedron above a triangle, over what an even prism would give it.
double least_volume_part(const Plan& plan, int triangle);

}  // namespace tunica::mesh::wall
