#pragma once
#include <string>

#include "tunica/systems/blocks.hpp"

namespace tunica::systems {

/// Makes a row of K without entries an equation x = 0, and marks it so in known_in. Returns a note
/// on such rows by their numbers in the files, from 1; empty where there are none. Collective.
std::string fill_empty_rows(Blocks& blocks, OfUnknowns& known_in);

/// A note where C has the sign that it has within K; empty where it has not. Collective.
std::string doubt_sign_of_c(const Blocks& blocks);

}  // namespace tunica::systems
