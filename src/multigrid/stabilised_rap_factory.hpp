#pragma once
#include <MueLu_RAPFactory.hpp>

#include "multigrid/mixed_coarsening.hpp"

namespace tunica::multigrid {

/// "StabilisedRAPFactory" of a MueLu list: Galerkin's coarse operator of a mixed system, with the
/// stabilisation block C multiplied by "stabilisation scaling" on each coarser level.
///
/// On a mesh of twice the size C ~ h² ought to be four times what Galerkin's product makes of it;
/// less leaves the coarse system short of stability [LY1, section 5].
class StabilisedRapFactory : public MueLu::RAPFactory<Scalar, LocalOrdinal, GlobalOrdinal, Node> {
public:
  /// Says how unknowns are numbered; before Build().
  void set_coarsening(const Teuchos::RCP<MixedCoarsening>& coarsening) { coarsening_ = coarsening; }

  Teuchos::RCP<const Teuchos::ParameterList> GetValidParameterList() const override;
  void Build(MueLu::Level& fine, MueLu::Level& coarse) const override;

private:
  Teuchos::RCP<MixedCoarsening> coarsening_;
};

}  // namespace tunica::multigrid
