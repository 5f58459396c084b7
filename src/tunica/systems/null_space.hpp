#pragma once
#include <vector>

#include "tunica/systems/node_table.hpp"
#include "tunica/systems/preparation.hpp"
#include "tunica/systems/read_system.hpp"

namespace tunica::systems {

/// Finds the constants n in the null space of K, |K n| ≤ 1e-8 ||K||n||, and makes K regular:
///
///   K' = K + σ e_k e_kᵀ     k the first unknown of the mode; σ < 0 for scalars
///
/// From nᵀ K' x = nᵀ b with nᵀ K = 0, nᵀ b = 0 follows x_k = 0 and K x = b: no equation is changed,
/// and levels of multigrid keep the term. Where nᵀ K = 0, the part of b along n, which no x gives,
/// is left out. Adds a note, or a remark. Collective.
std::vector<ConstantMode> hold_constants(Blocks& blocks, const NodeTable& table,
                                         Preparation& preparation);

}  // namespace tunica::systems
