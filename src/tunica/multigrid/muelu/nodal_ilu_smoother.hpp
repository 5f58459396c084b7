#pragma once
#include <memory>

#include "tunica/multigrid/muelu/mixed_smoother.hpp"
#include "tunica/smoothers/node_ilu/node_ilu.hpp"

namespace tunica::multigrid {

/// "NodalIluSmoother" of a MueLu list, for mixed matrices: x += ω (L U)⁻¹ (b − K x) with the
/// factors of NodeIlu. Its keys: "sweeps" (1), "damping" (1.0), "fill" (0), "precision" ("single",
/// "double").
class NodalIluSmoother : public MixedSmoother {
public:
  Teuchos::RCP<const Teuchos::ParameterList> GetValidParameterList() const override;
  Teuchos::RCP<MueLu::SmootherPrototype<Scalar, LocalOrdinal, GlobalOrdinal, Node>> Copy()
      const override;
  std::size_t getNodeSmootherComplexity() const override;
  void refresh() override { factors_->refresh(); }

private:
  void check(const Teuchos::ParameterList& list) const override;
  void set_up(const ::tunica::CrsMatrix& K, const algebra::DofLayout& numbering) override;
  void smooth(const ::tunica::MultiVector& b, ::tunica::MultiVector& x) const override;
  /// Without a product with K in the first sweep.
  void smooth_from_zero(const ::tunica::MultiVector& b, ::tunica::MultiVector& x) const override;
  void sweep(int n, const ::tunica::MultiVector& b, ::tunica::MultiVector& x) const;

  std::shared_ptr<smoothers::NodeIlu> factors_;
};

}  // namespace tunica::multigrid
