#pragma once
#include "tunica/linear/preconditioner_registry.hpp"

namespace tunica::linear {

/// "multigrid": cycles for the merged matrix by a MueLu list.
PreconditionerEntry cycle_preconditioner();

}  // namespace tunica::linear
