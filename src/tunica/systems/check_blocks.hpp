#pragma once
#include <string>

#include "tunica/systems/blocks.hpp"

namespace tunica::systems {

/// Makes a row of K without entries an equation x = 0 where its right-hand side is zero, too, or
/// no more than rounding beside the sums that made it (rounding_of_b, if given). Marks them in
/// is_known.
/// Returns a note on such rows by their numbers in the files, from 1; empty where there are none.
/// Throws Error where the right-hand side is not zero: nothing solves that. Collective.
std::string fill_empty_rows(Blocks& blocks, OfUnknowns& is_known,
                            const OfUnknowns* rounding_of_b = nullptr);

/// A note where C has the sign that it has within K; empty where it has not. Collective.
std::string doubt_sign_of_C(const Blocks& blocks);

}  // namespace tunica::systems
