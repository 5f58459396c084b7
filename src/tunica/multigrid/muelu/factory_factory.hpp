#pragma once
#include "tunica/multigrid/muelu/factory_registry.hpp"

namespace tunica::multigrid {

/// Knows the factories of MueLu and ours (factory_registry.hpp) by name: they mix freely in one
/// list.
Teuchos::RCP<FactoryFactory> make_factory_factory(const Teuchos::RCP<MixedCoarsening>& coarsening);

}  // namespace tunica::multigrid
