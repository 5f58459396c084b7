#pragma once
#include "tunica/linear/preconditioner_registry.hpp"

namespace tunica::linear {

/// "none": the Krylov method works on the merged matrix alone.
PreconditionerEntry no_preconditioner();

}  // namespace tunica::linear
