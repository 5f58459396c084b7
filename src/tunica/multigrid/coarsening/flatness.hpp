#pragma once
#include "tunica/algebra/block_space.hpp"

namespace tunica::multigrid {

/// Geometric mean over the nodes of solids of longest over shortest distance to a neighbour: 1.4 to
/// 2 in regular meshes, about width over thickness in layers of flat elements. 1 where
/// places are not known, or no solid is. Collective.
double flatness_of_solids(const CrsGraph& nodes, const algebra::NodePlaces& places);

}  // namespace tunica::multigrid
