#pragma once
#include <Ifpack2_Preconditioner.hpp>

#include "tunica/multigrid/muelu/matrix_smoother.hpp"

namespace tunica::multigrid {

/// "Ifpack2Smoother" of a MueLu list: what MueLu's "TrilinosSmoother" makes of the same keys
/// ("type", "overlap", "ParameterList"), but it follows new values without finding its graphs
/// again.
class Ifpack2Smoother : public MatrixSmoother {
public:
  Teuchos::RCP<const Teuchos::ParameterList> GetValidParameterList() const override;
  Teuchos::RCP<MueLu::SmootherPrototype<Scalar, LocalOrdinal, GlobalOrdinal, Node>> Copy()
      const override;
  void refresh() override;

private:
  using Inner = Ifpack2::Preconditioner<Scalar, LocalOrdinal, GlobalOrdinal, Node>;

  void check(const Teuchos::ParameterList& list) const override;
  void set_up(int level, const Teuchos::RCP<::tunica::CrsMatrix>& K) override;
  void smooth(const ::tunica::MultiVector& b, ::tunica::MultiVector& x) const override;

  Teuchos::RCP<Inner> inner_;
  Teuchos::RCP<::tunica::CrsMatrix> matrix_;
};

}  // namespace tunica::multigrid
