#pragma once
#include <Xpetra_CrsMatrixWrap.hpp>
#include <Xpetra_Matrix.hpp>
#include <Xpetra_TpetraCrsMatrix.hpp>
#include <Xpetra_TpetraMultiVector.hpp>
#include <functional>

#include "tunica/base/types.hpp"

namespace tunica::multigrid {

using XMatrix = Xpetra::Matrix<Scalar, LocalOrdinal, GlobalOrdinal, Node>;

/// A matrix as MueLu sees it; the storage is shared.
inline Teuchos::RCP<XMatrix> wrapped(const Teuchos::RCP<CrsMatrix>& matrix) {
  using XCrs = Xpetra::CrsMatrix<Scalar, LocalOrdinal, GlobalOrdinal, Node>;
  const Teuchos::RCP<XCrs> crs =
      Teuchos::rcp(new Xpetra::TpetraCrsMatrix<Scalar, LocalOrdinal, GlobalOrdinal, Node>(matrix));
  return Teuchos::rcp(new Xpetra::CrsMatrixWrap<Scalar, LocalOrdinal, GlobalOrdinal, Node>(crs));
}

/// A matrix of a level as MueLu sees it, which asks it for residuals. A smoother that has a smaller
/// copy of the matrix can offer to compute them.
class LevelMatrix : public Xpetra::CrsMatrixWrap<Scalar, LocalOrdinal, GlobalOrdinal, Node> {
public:
  using XVector = Xpetra::MultiVector<Scalar, LocalOrdinal, GlobalOrdinal, Node>;
  using Residual = std::function<void(const XVector& b, const XVector& x, XVector& r)>;

  explicit LevelMatrix(const Teuchos::RCP<::tunica::CrsMatrix>& matrix)
      : CrsMatrixWrap(Teuchos::rcp_dynamic_cast<CrsMatrixWrap>(wrapped(matrix))->getCrsMatrix()) {}
  void compute_residuals_by(const Residual& residual) { residual_ = residual; }
  void residual(const XVector& x, const XVector& b, XVector& r) const override {
    if (residual_) return residual_(b, x, r);
    CrsMatrixWrap::residual(x, b, r);
  }

private:
  Residual residual_;
};

/// The matrix that such a wrapper holds. Throws Teuchos::m_bad_cast for any other.
inline Teuchos::RCP<CrsMatrix> unwrapped(const Teuchos::RCP<XMatrix>& matrix) {
  using Wrap = Xpetra::CrsMatrixWrap<Scalar, LocalOrdinal, GlobalOrdinal, Node>;
  using XTpetra = Xpetra::TpetraCrsMatrix<Scalar, LocalOrdinal, GlobalOrdinal, Node>;
  const auto crs = Teuchos::rcp_dynamic_cast<Wrap>(matrix, true)->getCrsMatrix();
  return Teuchos::rcp_dynamic_cast<XTpetra>(crs, true)->getTpetra_CrsMatrixNonConst();
}

using XMultiVector = Xpetra::MultiVector<Scalar, LocalOrdinal, GlobalOrdinal, Node>;

/// The vectors behind such a wrapper. Throw Teuchos::m_bad_cast for any other.
inline Teuchos::RCP<MultiVector> unwrapped(XMultiVector& x) {
  using XTpetra = Xpetra::TpetraMultiVector<Scalar, LocalOrdinal, GlobalOrdinal, Node>;
  return Teuchos::dyn_cast<XTpetra>(x).getTpetra_MultiVector();
}
inline Teuchos::RCP<const MultiVector> unwrapped(const XMultiVector& x) {
  using XTpetra = Xpetra::TpetraMultiVector<Scalar, LocalOrdinal, GlobalOrdinal, Node>;
  return Teuchos::dyn_cast<const XTpetra>(x).getTpetra_MultiVector();
}

}  // namespace tunica::multigrid
