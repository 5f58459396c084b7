#pragma once
#include "tunica/linear/preconditioner_registry.hpp"

namespace tunica::linear {

/// "direct": sparse LU factors of the merged matrix, kept over the Newton steps of a time step.
PreconditionerEntry direct_preconditioner();

}  // namespace tunica::linear
