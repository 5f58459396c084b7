#pragma once
#include <MueLu_SmootherPrototype.hpp>

#include "multigrid/vanka.hpp"
#include "multigrid/xpetra.hpp"

namespace tunica::multigrid {

/// "VankaSmoother" of a MueLu list, for matrices with the unknowns 4*node + i, the pressure last.
/// Its keys: "sweeps" (1), "damping" (1.0), "order" ("forward", "backward", "symmetric"),
/// "combine" ("multiplicative", "additive"), "precision" ("double", "single").
class VankaSmoother : public MueLu::SmootherPrototype<Scalar, LocalOrdinal, GlobalOrdinal, Node> {
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
  std::shared_ptr<Vanka> vanka_;
};

}  // namespace tunica::multigrid
