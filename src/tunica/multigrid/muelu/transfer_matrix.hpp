#pragma once
#include "tunica/multigrid/muelu/xpetra.hpp"

namespace tunica::multigrid {

/// A prolongator as MueLu sees it, whose transpose is applied from the same storage as fast as the
/// matrix itself: a restriction needs no matrix of its own.
class TransferMatrix final
    : public Xpetra::CrsMatrixWrap<Scalar, LocalOrdinal, GlobalOrdinal, Node> {
public:
  explicit TransferMatrix(const Teuchos::RCP<::tunica::CrsMatrix>& matrix);
  using CrsMatrixWrap::apply;
  /// Y ← α P X + β Y or α Pᵀ X + β Y. Collective.
  void apply(const XMultiVector& X, XMultiVector& Y, Teuchos::ETransp mode, Scalar alpha,
             Scalar beta) const override;

private:
  Teuchos::RCP<::tunica::CrsMatrix> P_;
};

}  // namespace tunica::multigrid
