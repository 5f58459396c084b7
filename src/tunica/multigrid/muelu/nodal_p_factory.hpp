#pragma once
#include <MueLu_TwoLevelFactoryBase.hpp>

#include "tunica/multigrid/coarsening/mixed_coarsening.hpp"

namespace tunica::multigrid {

/// "NodalPFactory" of a MueLu list: the prolongator of a MixedCoarsening for the block, or for
/// both, that "A" is. Its key: "rotations" (false), by which displacements of solids are
/// interpolated so that rigid motions are exact (RigidInterpolation).
class NodalPFactory : public MueLu::TwoLevelFactoryBase {
public:
  /// Before Build().
  void set_coarsening(const Teuchos::RCP<MixedCoarsening>& coarsening) { coarsening_ = coarsening; }

  Teuchos::RCP<const Teuchos::ParameterList> GetValidParameterList() const override;
  void DeclareInput(MueLu::Level& fine, MueLu::Level& coarse) const override;
  void Build(MueLu::Level& fine, MueLu::Level& coarse) const override;

  /// True on a level whose prolongator such a factory made: it does not hang on values.
  static bool made_prolongator_of(MueLu::Level& level);

private:
  Teuchos::RCP<MixedCoarsening> coarsening_;
};

}  // namespace tunica::multigrid
