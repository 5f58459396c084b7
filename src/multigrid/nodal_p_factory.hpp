#pragma once
#include <MueLu_TwoLevelFactoryBase.hpp>

#include "multigrid/nodal_coarsening.hpp"

namespace tunica::multigrid {

/// "NodalPFactory" of a MueLu list: the prolongator of a NodalCoarsening, expanded to as many
/// unknowns per node as "A" has.
class NodalPFactory : public MueLu::TwoLevelFactoryBase {
public:
  explicit NodalPFactory(const Teuchos::RCP<NodalCoarsening>& coarsening)
      : coarsening_(coarsening) {}

  Teuchos::RCP<const Teuchos::ParameterList> GetValidParameterList() const override;
  void DeclareInput(MueLu::Level& fine, MueLu::Level& coarse) const override;
  void Build(MueLu::Level& fine, MueLu::Level& coarse) const override;

private:
  Teuchos::RCP<NodalCoarsening> coarsening_;
};

}  // namespace tunica::multigrid
