#pragma once
#include "tunica/linear/preconditioner_registry.hpp"

namespace tunica::linear {

/// "block": the blocks as they are, a BlockPreconditioner on them.
PreconditionerEntry block_preconditioner();

}  // namespace tunica::linear
