#pragma once
#include <MueLu_TwoLevelFactoryBase.hpp>

#include "tunica/multigrid/coarsening/mixed_coarsening.hpp"

namespace tunica::multigrid {

/// "NodalPFactory" of a MueLu list: the prolongator of a MixedCoarsening for the block, or for
/// both, that "A" is. Its keys: "rotations" (false), by which displacements of solids are
/// interpolated so that rigid motions are exact (RigidInterpolation), and "rotations from" (0), for
/// which see Cycle::note().
class NodalPFactory : public MueLu::TwoLevelFactoryBase {
public:
  static constexpr const char* rotations = "rotations";
  static constexpr const char* rotations_from = "rotations from";

  /// Before Build().
  void set_coarsening(const Teuchos::RCP<MixedCoarsening>& coarsening) { coarsening_ = coarsening; }

  Teuchos::RCP<const Teuchos::ParameterList> GetValidParameterList() const override;
  /// Throws std::invalid_argument for a contraction that is none.
  void SetParameterList(const Teuchos::ParameterList& list) override;
  void DeclareInput(MueLu::Level& fine, MueLu::Level& coarse) const override;
  void Build(MueLu::Level& fine, MueLu::Level& coarse) const override;

  /// True on a level whose prolongator such a factory made: it does not hang on values.
  static bool made_prolongator_of(MueLu::Level& level);

private:
  Teuchos::RCP<MixedCoarsening> coarsening_;
};

}  // namespace tunica::multigrid
