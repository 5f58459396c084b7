#pragma once
#include <MueLu_SmootherPrototype.hpp>
#include <memory>

#include "multigrid/braess_sarazin.hpp"
#include "multigrid/xpetra.hpp"

namespace tunica::multigrid {

/// "NodalBraessSarazinSmoother" of a MueLu list, for matrices with the unknowns 4*node + i, the
/// pressure last (MueLu's own "BraessSarazinSmoother" wants a blocked matrix). Its keys: "sweeps"
/// (1), "scaling" (2.0), "damping" (1.0), "schur" ("gauss-seidel", "chebyshev", "direct"),
/// "schur sweeps" (2).
class NodalBraessSarazinSmoother
    : public MueLu::SmootherPrototype<Scalar, LocalOrdinal, GlobalOrdinal, Node> {
public:
  Teuchos::RCP<const Teuchos::ParameterList> GetValidParameterList() const override;
  /// Throws std::invalid_argument for a word that it does not know.
  void SetParameterList(const Teuchos::ParameterList& list) override;
  void DeclareInput(MueLu::Level& level) const override;
  void Setup(MueLu::Level& level) override;
  void Apply(XMultiVector& x, const XMultiVector& b, bool is_zero) const override;
  Teuchos::RCP<MueLu::SmootherPrototype<Scalar, LocalOrdinal, GlobalOrdinal, Node>> Copy()
      const override;
  std::size_t getNodeSmootherComplexity() const override;

private:
  Teuchos::RCP<const ::tunica::CrsMatrix> K_;  // MueLu's base has a name of its own
  std::shared_ptr<BraessSarazin> smoother_;
};

}  // namespace tunica::multigrid
