#pragma once
#include "tunica/linear/preconditioner_registry.hpp"

namespace tunica::linear {

/// "direct": sparse LU factors of the merged matrix, worth it where they are kept.
PreconditionerEntry direct_preconditioner();

}  // namespace tunica::linear
