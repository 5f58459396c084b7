#pragma once
#include <memory>

#include "tunica/multigrid/muelu/smoothers/matrix_smoother.hpp"
#include "tunica/smoothers/braess_sarazin/braess_sarazin.hpp"

namespace tunica::multigrid {

/// "NodalBraessSarazinSmoother" of a MueLu list, for mixed matrices (MueLu's own
/// "BraessSarazinSmoother" wants a blocked matrix). Its keys: "sweeps" (1), "scaling" (0.0:
/// by the spectrum of A), "damping" (1.0), "schur" ("gauss-seidel", "chebyshev", "multigrid",
/// "direct"), "schur sweeps" (2).
class NodalBraessSarazinSmoother : public MixedSmoother {
public:
  Teuchos::RCP<const Teuchos::ParameterList> GetValidParameterList() const override;
  Teuchos::RCP<MueLu::SmootherPrototype<Scalar, LocalOrdinal, GlobalOrdinal, Node>> Copy()
      const override;
  void refresh() override { smoother_->refresh(); }

private:
  void check(const Teuchos::ParameterList& list) const override;
  void set_up(const ::tunica::CrsMatrix& K, const algebra::DofLayout& numbering) override;
  void smooth(const ::tunica::MultiVector& b, ::tunica::MultiVector& x) const override;

  std::shared_ptr<smoothers::BraessSarazin> smoother_;
};

}  // namespace tunica::multigrid
