#include "multigrid/schur_matrix.hpp"

#include <TpetraExt_MatrixMatrix.hpp>

namespace tunica::multigrid {

Teuchos::RCP<CrsMatrix> schur_matrix(const CrsMatrix& B1T, const CrsMatrix& B2, const CrsMatrix& mC,
                                     const Vector& inverse_D) {
  CrsMatrix scaled(B1T, Teuchos::Copy);
  scaled.leftScale(inverse_D);
  CrsMatrix product(B2.getRowMap(), 0);
  Tpetra::MatrixMatrix::Multiply(B2, false, scaled, false, product);
  return Tpetra::MatrixMatrix::add(1.0, false, product, -1.0, false, mC, mC.getDomainMap(),
                                   mC.getRangeMap());
}

}  // namespace tunica::multigrid
