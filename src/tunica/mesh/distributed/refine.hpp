#pragma once
#include <string>
#include <vector>

#include "tunica/mesh/distributed/slab.hpp"

namespace tunica::mesh {

/// Uniform refinement: each tetrahedron becomes 8, each triangle 4; regions and surfaces stay. No
/// rank sees more than its rows, and the result does not depend on how many there are.
///
/// Old vertices keep their numbers; one new vertex on each edge follows, sorted by the edge's
/// ends. The octahedron in the middle is cut along its shortest diagonal (of equal ones the
/// first), so volumes add up and faces match.
///
/// project: surfaces (names) whose new vertices are moved outwards onto the cylinder about the
/// z axis through the surface's old vertices. Throws Error on all ranks alike if a surface is no
/// such cylinder (radii differ by more than 0.1 %), if the motion inverts an element, or if the
/// result has more vertices or tetrahedra than can be numbered. Collective.
Slab refine(const Slab& slab, const std::vector<std::string>& project = {});

}  // namespace tunica::mesh
