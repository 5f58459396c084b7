#pragma once
#include "tunica/multigrid/coarsening/mixed_coarsening.hpp"

namespace tunica::multigrid {

/// The nodes of a mixed matrix (DofLayout) of any program. Two are neighbours where the graph of K
/// couples any unknown of one with any of the other, in either direction; the values do not count.
/// They are picked in the order of their numbers. Throws tunica::Error on all ranks where a node
/// lacks the scalar of block 1, or has it on another rank. Collective.
algebra::Nodes nodes_of(const CrsMatrix& K, const algebra::DofLayout& numbering);

/// Coarse nodes for a mixed matrix of any program with vectors of so many components, by
/// nodes_of(). Throws as that does. Collective.
Teuchos::RCP<MixedCoarsening> make_coarsening(const CrsMatrix& K, int components);

}  // namespace tunica::multigrid
