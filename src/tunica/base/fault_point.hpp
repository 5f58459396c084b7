#pragma once

namespace tunica {

/// Marks a place of a run. A message about exhausted memory names the last one passed. And a test
/// can have one rank fail there: TUNICA_FAULT="place:rank" or "place:rank:kind", read once, makes
/// the first pass of that rank throw; kind is "bad_alloc" (otherwise), "error" or "runtime".
/// A place is a literal without a colon, such as "mesh motion".
void fault_point(const char* place);

/// The last one that this rank has passed; "start" before any.
const char* last_fault_point();

}  // namespace tunica
