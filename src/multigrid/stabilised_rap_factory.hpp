#pragma once
#include <MueLu_RAPFactory.hpp>

#include "base/types.hpp"

namespace tunica::multigrid {

/// "StabilisedRAPFactory" of a MueLu list: Galerkin's coarse operator of a mixed system, with the
/// stabilisation block C multiplied by "stabilisation scaling" on each coarser level.
///
/// On a mesh of twice the size C ~ h² ought to be four times what Galerkin's product makes of it;
/// less leaves the coarse system short of stability [LY1, section 5].
///
/// The unknowns are numbered 4*node + i, the pressure last.
class StabilisedRapFactory : public MueLu::RAPFactory<Scalar, LocalOrdinal, GlobalOrdinal, Node> {
public:
  Teuchos::RCP<const Teuchos::ParameterList> GetValidParameterList() const override;
  void Build(MueLu::Level& fine, MueLu::Level& coarse) const override;
};

}  // namespace tunica::multigrid
