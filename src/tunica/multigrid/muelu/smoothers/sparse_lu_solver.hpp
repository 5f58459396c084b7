#pragma once
#include "tunica/multigrid/muelu/smoothers/matrix_smoother.hpp"
#include "tunica/smoothers/direct/sparse_lu.hpp"

namespace tunica::multigrid {

/// "SparseLUSolver" of a MueLu list, for the coarsest level: KLU2. It orders once and follows new
/// values by numeric factors.
class SparseLuSolver : public MatrixSmoother {
public:
  Teuchos::RCP<const Teuchos::ParameterList> GetValidParameterList() const override;
  Teuchos::RCP<MueLu::SmootherPrototype<Scalar, LocalOrdinal, GlobalOrdinal, Node>> Copy()
      const override;
  void refresh() override;

private:
  void check(const Teuchos::ParameterList&) const override {}
  void set_up(int level, const Teuchos::RCP<::tunica::CrsMatrix>& K) override;
  void smooth(const ::tunica::MultiVector& b, ::tunica::MultiVector& x) const override;

  Teuchos::RCP<smoothers::SparseLu> lu_;
};

}  // namespace tunica::multigrid
