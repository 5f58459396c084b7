#pragma once
#include "base/types.hpp"

namespace tunica::multigrid {

/// The unknowns dofs*node + i of the nodes, on the same ranks. Collective.
Teuchos::RCP<const Map> expanded_map(const Map& nodes, int dofs);

}  // namespace tunica::multigrid
