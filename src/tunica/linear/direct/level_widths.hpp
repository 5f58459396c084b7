#pragma once
#include "tunica/linear/direct/nested_dissection.hpp"

namespace tunica::linear {

/// Unknowns of the narrowest level in the middle of a graph, which any order of elimination has to
/// get across: levels are what a search in breadth from one end finds step by step, the middle is
/// what has a quarter of all unknowns before and behind it. A separator may be some two to three
/// times as narrow, since levels are oblique and as thick as an element. 0 for graphs in many
/// pieces. rows ascend.
double narrowest_level(int n, const Entries& entries);

}  // namespace tunica::linear
