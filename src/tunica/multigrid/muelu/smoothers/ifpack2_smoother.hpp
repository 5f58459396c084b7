#pragma once
#include <memory>

#include "tunica/multigrid/muelu/smoothers/ifpack2_sweeps.hpp"
#include "tunica/multigrid/muelu/smoothers/matrix_smoother.hpp"

namespace tunica::multigrid {

/// "Ifpack2Smoother" of a MueLu list: what MueLu's "TrilinosSmoother" makes of the same keys
/// ("type", "overlap", "ParameterList"), but it follows new values without finding its graphs
/// again.
class Ifpack2Smoother : public MatrixSmoother {
public:
  Teuchos::RCP<const Teuchos::ParameterList> GetValidParameterList() const override;
  Teuchos::RCP<MueLu::SmootherPrototype<Scalar, LocalOrdinal, GlobalOrdinal, Node>> Copy()
      const override;
  void refresh() override { sweeps_->refresh(); }

private:
  void check(const Teuchos::ParameterList& list) const override { Ifpack2Sweeps::check(list); }
  void set_up(int level, const Teuchos::RCP<::tunica::CrsMatrix>& K) override;
  void smooth(const ::tunica::MultiVector& b, ::tunica::MultiVector& x) const override {
    sweeps_->smooth(b, x);
  }

  std::shared_ptr<Ifpack2Sweeps> sweeps_;
};

}  // namespace tunica::multigrid
