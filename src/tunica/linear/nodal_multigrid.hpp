#pragma once

namespace tunica::linear {

/// Registers the inverse "Nodal Multigrid" with Teko: a cycle of MueLu on coarse nodes that all
/// blocks of a field share (multigrid/coarsening/nodal_coarsening.hpp), for a block with any number
/// of unknowns per node. The nodes come from a request for "Nodal Coarsening". Its keys in a
/// library: "Sweeps" of symmetric Gauss-Seidel before and after the coarse correction (1), "Coarse
/// Size" in unknowns (500), or a whole list "MueLu" in the form of factories, in which
/// "NodalPFactory" stands beside MueLu's own.
void register_nodal_multigrid();

}  // namespace tunica::linear
