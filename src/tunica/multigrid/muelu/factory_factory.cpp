#include "tunica/multigrid/muelu/factory_factory.hpp"

#include <MueLu_SmootherFactory.hpp>

#include "tunica/multigrid/muelu/matrix_kind.hpp"
#include "tunica/multigrid/muelu/smoothers/pressure_schwarz_smoother.hpp"
#include "tunica/multigrid/muelu/smoothers/zero_start_smoother.hpp"

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
  // One prototype serves before and behind the coarse correction.
  Teuchos::RCP<ZeroStartSmoother::Prototype> before, after;
  Teuchos::rcp_dynamic_cast<const Smoothers>(theirs, true)->GetSmootherPrototypes(before, after);
  return smoother(Teuchos::rcp(new ZeroStartSmoother(before)));
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

  // Ours by their names, Schwarz with a patch for each pressure, and MueLu's others. Some of these
  // add to what x holds even from a zero start: they get a zero there.
  Teuchos::RCP<const MueLu::FactoryBase> BuildFactory(const Teuchos::ParameterEntry& entry,
                                                      const Factories& factories,
                                                      const Managers& managers) const override {
    const bool is_list = entry.isList();
    auto list =
        is_list ? Teuchos::getValue<Teuchos::ParameterList>(entry) : Teuchos::ParameterList();
    const auto name =
        is_list ? list.get<std::string>("factory") : Teuchos::getValue<std::string>(entry);
    if (const FactoryEntry* const ours = find_factory(name))
      return ours->make({list, *this, factories, managers, coarsening_});
    if (is_schwarz_of_pressures(list)) return smoother(pressure_schwarz(list, factories, managers));
    const Quiet quiet(name);
    const auto factory = FactoryFactory::BuildFactory(entry, factories, managers);
    const bool is_for_blocks = name == "BraessSarazinSmoother" || name == "SimpleSmoother" ||
                               name == "UzawaSmoother" || name == "BlockedJacobiSmoother" ||
                               name == "IndefiniteBlockDiagonalSmoother";
    return is_for_blocks ? from_zero(factory) : factory;
  }

private:
  Teuchos::RCP<PressureSchwarzSmoother> pressure_schwarz(Teuchos::ParameterList list,
                                                         const Factories& factories,
                                                         const Managers& managers) const {
    // Between ranks; how far patches reach is a key of Ifpack2's own list.
    const int overlap = list.isParameter("overlap") ? list.get<int>("overlap") : 0;
    const auto schwarz =
        Teuchos::rcp(new PressureSchwarzSmoother(list.sublist("ParameterList"), overlap));
    if (list.isParameter("A"))
      schwarz->SetFactory("A", BuildFactory(list.getEntry("A"), factories, managers));
    return schwarz;
  }

  Teuchos::RCP<MixedCoarsening> coarsening_;
};

}  // namespace

Teuchos::RCP<FactoryFactory> make_factory_factory(const Teuchos::RCP<MixedCoarsening>& coarsening) {
  return Teuchos::rcp(new OurFactories(coarsening));
}

}  // namespace tunica::multigrid
