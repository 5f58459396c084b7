#pragma once
#include <MueLu_SmootherPrototype.hpp>

#include "multigrid/mixed_coarsening.hpp"
#include "multigrid/xpetra.hpp"

namespace tunica::multigrid {

/// What smoothers of a MueLu list for mixed matrices have in common.
class MixedSmoother : public MueLu::SmootherPrototype<Scalar, LocalOrdinal, GlobalOrdinal, Node> {
public:
  /// Says how unknowns are numbered; before Setup().
  void set_coarsening(const Teuchos::RCP<MixedCoarsening>& coarsening) { coarsening_ = coarsening; }

  /// Throws std::invalid_argument for a word or number that the smoother does not permit.
  void SetParameterList(const Teuchos::ParameterList& list) override;
  void DeclareInput(MueLu::Level& level) const override;
  void Setup(MueLu::Level& level) override;
  void Apply(XMultiVector& x, const XMultiVector& b, bool is_zero) const override;

protected:
  virtual void check(const Teuchos::ParameterList& list) const = 0;
  virtual void set_up(const ::tunica::CrsMatrix& K) = 0;
  virtual void smooth(const ::tunica::MultiVector& b, ::tunica::MultiVector& x) const = 0;

  const ::tunica::CrsMatrix& K() const { return *K_; }
  const MixedNumbering& numbering() const { return coarsening_->numbering(); }

private:
  Teuchos::RCP<MixedCoarsening> coarsening_;
  Teuchos::RCP<const ::tunica::CrsMatrix> K_;  // MueLu's base has names of its own
};

}  // namespace tunica::multigrid
