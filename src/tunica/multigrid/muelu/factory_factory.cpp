#include "tunica/multigrid/muelu/factory_factory.hpp"

#include <MueLu_SmootherFactory.hpp>

#include "tunica/multigrid/muelu/braess_sarazin_smoother.hpp"
#include "tunica/multigrid/muelu/galerkin_factory.hpp"
#include "tunica/multigrid/muelu/ifpack2_smoother.hpp"
#include "tunica/multigrid/muelu/matrix_kind.hpp"
#include "tunica/multigrid/muelu/nodal_blocked_p_factory.hpp"
#include "tunica/multigrid/muelu/nodal_ilu_smoother.hpp"
#include "tunica/multigrid/muelu/nodal_p_factory.hpp"
#include "tunica/multigrid/muelu/pressure_schwarz_smoother.hpp"
#include "tunica/multigrid/muelu/sparse_lu_solver.hpp"
#include "tunica/multigrid/muelu/vanka_smoother.hpp"
#include "tunica/multigrid/muelu/zero_start_smoother.hpp"
#include "tunica/params/known_keys.hpp"

namespace tunica::multigrid {

namespace {

using Factories = std::map<std::string, Teuchos::RCP<const MueLu::FactoryBase>>;
using Managers = std::map<std::string, Teuchos::RCP<MueLu::FactoryManagerBase>>;

Teuchos::RCP<const MueLu::FactoryBase> smoother(
    const Teuchos::RCP<MueLu::SmootherPrototype<Scalar, LocalOrdinal, GlobalOrdinal, Node>>&
        prototype) {
  return Teuchos::rcp(
      new MueLu::SmootherFactory<Scalar, LocalOrdinal, GlobalOrdinal, Node>(prototype));
}

Teuchos::RCP<const MueLu::FactoryBase> from_zero(
    const Teuchos::RCP<const MueLu::FactoryBase>& theirs) {
  using Smoothers = MueLu::SmootherFactory<Scalar, LocalOrdinal, GlobalOrdinal, Node>;
  Teuchos::RCP<ZeroStartSmoother::Prototype> before, after;
  Teuchos::rcp_dynamic_cast<const Smoothers>(theirs, true)->GetSmootherPrototypes(before, after);
  return smoother(Teuchos::rcp(new ZeroStartSmoother(before)));
}

/// MueLu passes over what a factory does not know.
void check_keys(const Teuchos::ParameterList& list, const MueLu::Factory& factory) {
  const auto valid = factory.GetValidParameterList();
  std::vector<std::string> known{"factory"};
  for (const auto& item : *valid) known.push_back(item.first);
  params::check_keys(list, known,
                     list.isParameter("factory") ? list.get<std::string>("factory") : "");
}

/// BlockedDirectSolver names its solver on the screen each time it is made, even in a list that
/// asks for silence.
class Quiet {
public:
  explicit Quiet(const std::string& factory)
      : before_(MueLu::VerboseObject::GetDefaultVerbLevel()) {
    if (factory == "BlockedDirectSolver") MueLu::VerboseObject::SetDefaultVerbLevel(MueLu::None);
  }
  ~Quiet() { MueLu::VerboseObject::SetDefaultVerbLevel(before_); }
  Quiet(const Quiet&) = delete;
  Quiet& operator=(const Quiet&) = delete;

private:
  MueLu::VerbLevel before_;
};

class OurFactories final : public FactoryFactory {
public:
  explicit OurFactories(const Teuchos::RCP<MixedCoarsening>& coarsening)
      : coarsening_(coarsening) {}

  Teuchos::RCP<const MueLu::FactoryBase> BuildFactory(const Teuchos::ParameterEntry& entry,
                                                      const Factories& factories,
                                                      const Managers& managers) const override {
    const bool is_list = entry.isList();
    auto list =
        is_list ? Teuchos::getValue<Teuchos::ParameterList>(entry) : Teuchos::ParameterList();
    const auto name =
        is_list ? list.get<std::string>("factory") : Teuchos::getValue<std::string>(entry);
    if (name == "GalerkinFactory") return placed<GalerkinFactory>(list, factories, managers);
    if (name == "Ifpack2Smoother")
      return smoother(built<tunica::multigrid::Ifpack2Smoother>(list, factories, managers));
    if (name == "SparseLUSolver") return smoother(built<SparseLuSolver>(list, factories, managers));
    if (name == "NodalBraessSarazinSmoother")
      return smoother(placed<NodalBraessSarazinSmoother>(list, factories, managers));
    if (name == "VankaSmoother") return smoother(placed<VankaSmoother>(list, factories, managers));
    if (name == "NodalIluSmoother")
      return smoother(placed<NodalIluSmoother>(list, factories, managers));
    if (name == "NodalPFactory") return nodal<NodalPFactory>(list, factories, managers);
    if (name == "NodalBlockedPFactory")
      return nodal<NodalBlockedPFactory>(list, factories, managers);
    if (is_schwarz_of_pressures(list))
      return smoother(with_matrix(pressure_schwarz(list), list, factories, managers));
    const Quiet quiet(name);
    const auto factory = FactoryFactory::BuildFactory(entry, factories, managers);
    const bool is_for_blocks = name == "BraessSarazinSmoother" || name == "SimpleSmoother" ||
                               name == "UzawaSmoother" || name == "BlockedJacobiSmoother" ||
                               name == "IndefiniteBlockDiagonalSmoother";
    return is_for_blocks ? from_zero(factory) : factory;
  }

private:
  template <class Ours>
  Teuchos::RCP<Ours> built(const Teuchos::ParameterList& list, const Factories& factories,
                           const Managers& managers) const {
    check_keys(list, Ours());
    return Build2<Ours>(list, factories, managers);
  }
  /// The same for those that know the numbers of unknowns.
  template <class Ours>
  Teuchos::RCP<Ours> placed(const Teuchos::ParameterList& list, const Factories& factories,
                            const Managers& managers) const {
    const auto factory = built<Ours>(list, factories, managers);
    factory->set_coarsening(coarsening_);
    return factory;
  }

  template <class Ours>
  Teuchos::RCP<Ours> nodal(const Teuchos::ParameterList& list, const Factories& factories,
                           const Managers& managers) const {
    const auto factory = Teuchos::rcp(new Ours(coarsening_));
    check_keys(list, *factory);
    return with_matrix(factory, list, factories, managers);
  }

  static Teuchos::RCP<PressureSchwarzSmoother> pressure_schwarz(Teuchos::ParameterList list) {
    const int overlap = list.isParameter("overlap") ? list.get<int>("overlap") : 0;
    return Teuchos::rcp(new PressureSchwarzSmoother(list.sublist("ParameterList"), overlap));
  }

  /// The factory, with the matrix that the list names.
  template <class Ours>
  Teuchos::RCP<Ours> with_matrix(const Teuchos::RCP<Ours>& factory,
                                 const Teuchos::ParameterList& list, const Factories& factories,
                                 const Managers& managers) const {
    if (list.isParameter("A"))
      factory->SetFactory("A", BuildFactory(list.getEntry("A"), factories, managers));
    return factory;
  }

  Teuchos::RCP<MixedCoarsening> coarsening_;
};

}  // namespace

Teuchos::RCP<FactoryFactory> make_factory_factory(const Teuchos::RCP<MixedCoarsening>& coarsening) {
  return Teuchos::rcp(new OurFactories(coarsening));
}

std::vector<std::string> our_factories() {
  return {
      "GalerkinFactory",  "Ifpack2Smoother", "NodalBlockedPFactory", "NodalBraessSarazinSmoother",
      "NodalIluSmoother", "NodalPFactory",   "SparseLUSolver",       "VankaSmoother"};
}

}  // namespace tunica::multigrid
