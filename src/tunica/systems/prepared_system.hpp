#pragma once
#include "tunica/systems/blocks.hpp"
#include "tunica/systems/read_system.hpp"

namespace tunica::systems {

/// K as it is solved with, dealt to the ranks; without a right-hand side. order: of the scalars, in
/// words. A node map is read some lines at once. Throws Error on all ranks where options do not
/// fit. Collective.
System prepared_system(Blocks given, const Teuchos::ParameterList& options,
                       const std::string& order, std::size_t lines_at_once = entries_at_once);

}  // namespace tunica::systems
