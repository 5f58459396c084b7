#pragma once
#include "tunica/multigrid/muelu/factory_registry.hpp"

namespace tunica::multigrid {

/// Knows the factories of MueLu and ours (factory_registry.hpp) by name: they mix freely in one
/// list. For Cycle, and for any other MueLu::ParameterListInterpreter:
///
///   const auto factories = make_factory_factory(make_coarsening(*K, components));
///   MueLu::ParameterListInterpreter<...> interpreter(list, comm, factories);
Teuchos::RCP<FactoryFactory> make_factory_factory(const Teuchos::RCP<MixedCoarsening>& coarsening);

}  // namespace tunica::multigrid
