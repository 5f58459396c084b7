#pragma once
#include "tunica/linear/preconditioner_registry.hpp"

namespace tunica::linear {

/// "field by field": block Gauss-Seidel over the parts of a coupled system, each with a linear
/// solver of its own. Its make() throws tunica::Error for parts that the system lacks or that no
/// entry has.
PreconditionerEntry field_preconditioner();

}  // namespace tunica::linear
