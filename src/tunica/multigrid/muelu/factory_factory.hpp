#pragma once
#include <MueLu_FactoryFactory.hpp>

#include "tunica/multigrid/coarsening/mixed_coarsening.hpp"

namespace tunica::multigrid {

using FactoryFactory = MueLu::FactoryFactory<Scalar, LocalOrdinal, GlobalOrdinal, Node>;

/// Knows the factories of MueLu and ours by name: they mix freely in one list. For Cycle, and for
/// any other MueLu::ParameterListInterpreter:
///
///   const auto factories = make_factory_factory(make_coarsening(*K, components));
///   MueLu::ParameterListInterpreter<...> interpreter(list, comm, factories);
Teuchos::RCP<FactoryFactory> make_factory_factory(const Teuchos::RCP<MixedCoarsening>& coarsening);

/// The names of ours.
std::vector<std::string> our_factories();

}  // namespace tunica::multigrid
