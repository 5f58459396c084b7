#pragma once
#include <Xpetra_CrsMatrixWrap.hpp>
#include <Xpetra_Matrix.hpp>
#include <Xpetra_TpetraCrsMatrix.hpp>

#include "base/types.hpp"

namespace tunica::multigrid {

using XMatrix = Xpetra::Matrix<Scalar, LocalOrdinal, GlobalOrdinal, Node>;

/// A matrix as MueLu sees it; the storage is shared.
inline Teuchos::RCP<XMatrix> wrapped(const Teuchos::RCP<CrsMatrix>& matrix) {
  using XCrs = Xpetra::CrsMatrix<Scalar, LocalOrdinal, GlobalOrdinal, Node>;
  const Teuchos::RCP<XCrs> crs =
      Teuchos::rcp(new Xpetra::TpetraCrsMatrix<Scalar, LocalOrdinal, GlobalOrdinal, Node>(matrix));
  return Teuchos::rcp(new Xpetra::CrsMatrixWrap<Scalar, LocalOrdinal, GlobalOrdinal, Node>(crs));
}

}  // namespace tunica::multigrid
