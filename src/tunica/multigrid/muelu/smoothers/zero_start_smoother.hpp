#pragma once
#include <MueLu_SmootherPrototype.hpp>

#include "tunica/multigrid/muelu/xpetra.hpp"

namespace tunica::multigrid {

/// Another smoother that finds a zero where it is told of one: MueLu does not set it, and its
/// smoothers for blocks (but Gauss-Seidel) add to what the caller's vector held, or on the coarse
/// levels of a W-cycle to the last correction.
class ZeroStartSmoother
    : public MueLu::SmootherPrototype<Scalar, LocalOrdinal, GlobalOrdinal, Node> {
public:
  using Prototype = MueLu::SmootherPrototype<Scalar, LocalOrdinal, GlobalOrdinal, Node>;

  explicit ZeroStartSmoother(const Teuchos::RCP<Prototype>& smoother) : smoother_(smoother) {}

  void DeclareInput(MueLu::Level& level) const override;
  void Setup(MueLu::Level& level) override;
  void Apply(XMultiVector& x, const XMultiVector& b, bool is_zero) const override;
  Teuchos::RCP<Prototype> Copy() const override;
  std::size_t getNodeSmootherComplexity() const override;

private:
  Teuchos::RCP<Prototype> smoother_;
};

}  // namespace tunica::multigrid
