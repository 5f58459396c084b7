#pragma once
#include <vector>

#include "tunica/systems/read_system.hpp"

namespace tunica::systems {

/// The constants n in the null space of K, |K n| ≤ 1e-8 ||K||n||; left: n in that of Kᵀ, if it is.
/// K has not been made regular. Collective.
std::vector<ConstantMode> find_constants(const System& system);

/// Makes K regular:
///
///   K' = K + σ e_k e_kᵀ     k the first unknown of the mode; σ < 0 for scalars
///
/// From nᵀ K' x = nᵀ b with nᵀ K = 0, nᵀ b = 0 follows x_k = 0 and K x = b: no equation is changed,
/// and levels of multigrid keep the term. Collective.
void hold_constants(System& system);

/// b ← b − n (nᵀb)/(nᵀn) where nᵀ K = 0 and the border does not take it: no x gives that part. A
/// remark on each mode of which b has one. Collective.
std::vector<std::string> leave_out_constants(const System& system, algebra::BlockVector& b);

}  // namespace tunica::systems
