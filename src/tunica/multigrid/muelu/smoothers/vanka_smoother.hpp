#pragma once
#include <memory>

#include "tunica/multigrid/muelu/smoothers/matrix_smoother.hpp"
#include "tunica/smoothers/vanka/vanka.hpp"

namespace tunica::multigrid {

/// "VankaSmoother" of a MueLu list, for mixed matrices.
/// Its keys: "sweeps" (1), "damping" (1.0), "order" ("forward", "backward", "symmetric"),
/// "combine" ("multiplicative", "additive"), "precision" ("double", "single"), "patch" ("full",
/// "diagonal", "node pair").
class VankaSmoother : public MixedSmoother {
public:
  Teuchos::RCP<const Teuchos::ParameterList> GetValidParameterList() const override;
  Teuchos::RCP<MueLu::SmootherPrototype<Scalar, LocalOrdinal, GlobalOrdinal, Node>> Copy()
      const override;
  std::size_t getNodeSmootherComplexity() const override;
  void refresh() override { vanka_->refresh(); }

private:
  void check(const Teuchos::ParameterList& list) const override;
  void set_up(const ::tunica::CrsMatrix& K, const algebra::DofLayout& numbering) override;
  void smooth(const ::tunica::MultiVector& b, ::tunica::MultiVector& x) const override;

  std::shared_ptr<smoothers::Vanka> vanka_;
};

}  // namespace tunica::multigrid
