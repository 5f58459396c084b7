#pragma once
#include <Teuchos_ParameterList.hpp>
#include <string>

namespace tunica::setup {

/// Leaves of a coupled case, not yet resolved, what a program for one field solves: the other field
/// with its probes and the coupling go. On the interface a wall becomes free, and a fluid sticks to
/// a rigid wall. Returns what was left out, for the user; empty where that is nothing.
std::string leave_one_field(Teuchos::ParameterList& list, const std::string& program);

}  // namespace tunica::setup
