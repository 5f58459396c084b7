#pragma once
#include <string>

#include "tunica/params/table.hpp"

namespace tunica::stepping {

/// How long a run may take by the clock on the wall [s], from a text: seconds, or h:mm:ss. Infinite
/// for an empty one. Throws Error for anything else.
double seconds_of(const std::string& text);

/// Adds the key "wall limit" to a "Time" list.
void add_wall_limit(params::Table& time);

}  // namespace tunica::stepping
