#include "tunica/multigrid/muelu/factory_registry.hpp"

#include <MueLu_FactoryFactory_def.hpp>  // from 14 on Build2() is a template of its own
#include <MueLu_SmootherFactory.hpp>
#include <algorithm>
#include <type_traits>

#include "tunica/base/formatted.hpp"
#include "tunica/multigrid/muelu/galerkin_factory.hpp"
#include "tunica/multigrid/muelu/nodal_blocked_p_factory.hpp"
#include "tunica/multigrid/muelu/nodal_p_factory.hpp"
#include "tunica/multigrid/muelu/smoothers/braess_sarazin_smoother.hpp"
#include "tunica/multigrid/muelu/smoothers/field_smoother.hpp"
#include "tunica/multigrid/muelu/smoothers/ifpack2_smoother.hpp"
#include "tunica/multigrid/muelu/smoothers/nodal_ilu_smoother.hpp"
#include "tunica/multigrid/muelu/smoothers/sparse_lu_solver.hpp"
#include "tunica/multigrid/muelu/smoothers/vanka_smoother.hpp"
#include "tunica/params/known_keys.hpp"

namespace tunica::multigrid {

namespace {

using Made = Teuchos::RCP<const MueLu::FactoryBase>;

/// MueLu passes over what a factory does not know.
void check_keys(const Teuchos::ParameterList& list, const MueLu::Factory& factory) {
  const auto valid = factory.GetValidParameterList();
  std::vector<std::string> known{"factory"};
  for (const auto& item : *valid) known.push_back(item.first);
  params::check_keys(list, known,
                     list.isParameter("factory") ? list.get<std::string>("factory") : "");
}

template <class Ours>
Teuchos::RCP<Ours> built(const FactoryRequest& request) {
  // A new factory with the keys of the list, and with the factories that it names.
  check_keys(request.list, Ours());
  return request.builder.template Build2<Ours>(request.list, request.factories, request.managers);
}

/// Those for mixed matrices know the numbers of the unknowns.
template <class Ours>
Made smoother(const FactoryRequest& request) {
  using Smoothers = MueLu::SmootherFactory<Scalar, LocalOrdinal, GlobalOrdinal, Node>;
  const Teuchos::RCP<Ours> prototype = built<Ours>(request);
  if constexpr (std::is_base_of_v<MixedSmoother, Ours>)
    prototype->set_coarsening(request.coarsening);
  return Teuchos::rcp(new Smoothers(prototype));
}

/// Of prolongators and products.
template <class Ours>
Made transfer(const FactoryRequest& request) {
  const auto factory = built<Ours>(request);
  factory->set_coarsening(request.coarsening);
  return factory;
}

}  // namespace

const std::vector<FactoryEntry>& our_factories() {
  static const std::vector<FactoryEntry> all = {
      {"NodalPFactory", MatrixKind::merged, transfer<NodalPFactory>},
      {"GalerkinFactory", MatrixKind::merged, transfer<GalerkinFactory>},
      {"NodalIluSmoother", MatrixKind::merged, smoother<NodalIluSmoother>},
      {"VankaSmoother", MatrixKind::merged, smoother<VankaSmoother>},
      {"NodalBraessSarazinSmoother", MatrixKind::merged, smoother<NodalBraessSarazinSmoother>},
      {"FieldSmoother", MatrixKind::merged, smoother<FieldSmoother>},
      {"Ifpack2Smoother", MatrixKind::either, smoother<Ifpack2Smoother>},
      {"SparseLUSolver", MatrixKind::either, smoother<SparseLuSolver>},
      {"NodalBlockedPFactory", MatrixKind::blocked, transfer<NodalBlockedPFactory>},
  };
  return all;
}

const FactoryEntry* find_factory(const std::string& name) {
  const auto& all = our_factories();
  const auto found = std::find_if(all.begin(), all.end(),
                                  [&](const FactoryEntry& entry) { return entry.name == name; });
  return found == all.end() ? nullptr : &*found;
}

std::string our_factories_text() {
  std::vector<std::string> others, on_blocks;
  for (const FactoryEntry& entry : our_factories())
    (entry.works_on == MatrixKind::blocked ? on_blocks : others).push_back(entry.name);
  return listed(others) + ", on blocks " + listed(on_blocks);
}

}  // namespace tunica::multigrid
