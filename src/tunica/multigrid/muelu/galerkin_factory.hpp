#pragma once
#include <MueLu_TwoLevelFactoryBase.hpp>

#include "tunica/algebra/refreshable.hpp"
#include "tunica/multigrid/coarsening/mixed_coarsening.hpp"

namespace tunica::multigrid {

/// "GalerkinFactory" of a MueLu list: the coarse operator R A P, with the stabilisation block C of
/// a mixed matrix multiplied by "stabilisation scaling" (1.0) on each coarser level. Its graphs are
/// found once: see GalerkinProduct, which it leaves on the coarse level. "R" may be "NoFactory":
/// then R = Pᵀ needs no storage, and the hierarchy wants "transpose: use implicit", too.
///
/// On a mesh of twice the size C ~ h² ought to be four times what Galerkin's product makes of it;
/// less leaves the coarse system short of stability [LY1, section 5]. Where C is zero, "schur
/// stabilisation" (0.0) is the part of B2 diag(A)⁻¹ B1ᵀ, of the finer level, that C gets; "least
/// stabilisation" (0.0) that below which C is enlarged. None of the three may be negative.
class GalerkinFactory : public MueLu::TwoLevelFactoryBase {
public:
  /// Says how unknowns are numbered; before Build().
  void set_coarsening(const Teuchos::RCP<MixedCoarsening>& coarsening) { coarsening_ = coarsening; }

  Teuchos::RCP<const Teuchos::ParameterList> GetValidParameterList() const override;
  /// Throws std::invalid_argument for a negative number.
  void SetParameterList(const Teuchos::ParameterList& list) override;
  void DeclareInput(MueLu::Level& fine, MueLu::Level& coarse) const override;
  void Build(MueLu::Level& fine, MueLu::Level& coarse) const override;

private:
  Teuchos::RCP<MixedCoarsening> coarsening_;
};

/// The product on a level that such a factory made; null on any other.
Teuchos::RCP<algebra::Refreshable> galerkin_product(MueLu::Level& level);

}  // namespace tunica::multigrid
