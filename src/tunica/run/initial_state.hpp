#pragma once
#include "tunica/run/field_problems.hpp"

namespace tunica::run {

/// Gives the fields, which stand at their start, the velocity, pressure and displacement of another
/// run, interpolated from its mesh, and moves the fluid's mesh with the wall. A node outside of
/// that mesh has the values of the nearest place in it; the screen tells how many there are, and
/// how far. What that run does not have stays as it is. Fails where the mesh cannot follow. Throws
/// Error on all ranks alike where its fields cannot be read. Collective.
Outcome take_initial_state(const setup::InitialState& from, FieldProblems& problems);

}  // namespace tunica::run
