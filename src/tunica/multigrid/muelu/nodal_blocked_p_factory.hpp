#pragma once
#include <MueLu_TwoLevelFactoryBase.hpp>

#include "tunica/multigrid/coarsening/mixed_coarsening.hpp"

namespace tunica::multigrid {

/// "NodalBlockedPFactory" of a MueLu list for a matrix of blocks: the prolongator of a
/// MixedCoarsening, the same nodes for both blocks. It makes "P" and "R", the transpose, which
/// MueLu wants explicitly where there are blocks.
class NodalBlockedPFactory : public MueLu::TwoLevelFactoryBase {
public:
  /// Before Build().
  void set_coarsening(const Teuchos::RCP<MixedCoarsening>& coarsening) { coarsening_ = coarsening; }

  Teuchos::RCP<const Teuchos::ParameterList> GetValidParameterList() const override;
  void DeclareInput(MueLu::Level& fine, MueLu::Level& coarse) const override;
  void Build(MueLu::Level& fine, MueLu::Level& coarse) const override;

private:
  Teuchos::RCP<MixedCoarsening> coarsening_;
};

}  // namespace tunica::multigrid
