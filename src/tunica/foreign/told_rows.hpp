#pragma once
#include <string>

#include "tunica/systems/read_system.hpp"

namespace tunica::foreign {

/// A message of a smoother about "row 17 of 6400" or "node 5 of 6400" unknowns of a matrix in which
/// those of a node stand side by side, in the user's terms: "row 9 of B2 and C", "rows 3, 4 and 12
/// of K". Of a coarse level, which has fewer unknowns, it stays as it is. The same on all ranks.
/// Collective.
std::string with_rows_of_files(const systems::System& system, const std::string& message);

}  // namespace tunica::foreign
