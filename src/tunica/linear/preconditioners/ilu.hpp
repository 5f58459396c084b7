#pragma once
#include "tunica/linear/preconditioner_registry.hpp"

namespace tunica::linear {

/// "ilu": incomplete LU factors of the merged matrix, additive Schwarz between the ranks (Ifpack2).
PreconditionerEntry ilu_preconditioner();

}  // namespace tunica::linear
