#include "multigrid/factory_factory.hpp"

#include "multigrid/nodal_p_factory.hpp"

namespace tunica::multigrid {

namespace {

using Factories = std::map<std::string, Teuchos::RCP<const MueLu::FactoryBase>>;
using Managers = std::map<std::string, Teuchos::RCP<MueLu::FactoryManagerBase>>;

class OurFactories final : public FactoryFactory {
public:
  explicit OurFactories(const Teuchos::RCP<NodalCoarsening>& coarsening)
      : coarsening_(coarsening) {}

  Teuchos::RCP<const MueLu::FactoryBase> BuildFactory(const Teuchos::ParameterEntry& entry,
                                                      const Factories& factories,
                                                      const Managers& managers) const override {
    const bool is_list = entry.isList();
    const auto name =
        is_list ? Teuchos::getValue<Teuchos::ParameterList>(entry).get<std::string>("factory")
                : Teuchos::getValue<std::string>(entry);
    if (name != "NodalPFactory") return FactoryFactory::BuildFactory(entry, factories, managers);
    const auto factory = Teuchos::rcp(new NodalPFactory(coarsening_));
    if (is_list) {
      const auto& list = Teuchos::getValue<Teuchos::ParameterList>(entry);
      if (list.isParameter("A"))
        factory->SetFactory("A", BuildFactory(list.getEntry("A"), factories, managers));
    }
    return factory;
  }

private:
  Teuchos::RCP<NodalCoarsening> coarsening_;
};

}  // namespace

Teuchos::RCP<FactoryFactory> make_factory_factory(const Teuchos::RCP<NodalCoarsening>& coarsening) {
  return Teuchos::rcp(new OurFactories(coarsening));
}

}  // namespace tunica::multigrid
