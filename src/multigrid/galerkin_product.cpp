#include "multigrid/galerkin_product.hpp"

#include <TpetraExt_MatrixMatrix.hpp>

namespace tunica::multigrid {

GalerkinProduct::GalerkinProduct(const Teuchos::RCP<const CrsMatrix>& R,
                                 const Teuchos::RCP<const CrsMatrix>& A,
                                 const Teuchos::RCP<const CrsMatrix>& P,
                                 const MixedNumbering& numbering, double stabilisation_factor)
    : R_(R), A_(A), P_(P), numbering_(numbering), stabilisation_factor_(stabilisation_factor),
      AP_(Teuchos::rcp(new CrsMatrix(A->getRowMap(), 0))),
      RAP_(Teuchos::rcp(new CrsMatrix(R->getRowMap(), 0))) {
  refresh();
}

void GalerkinProduct::refresh() {
  // The second time Tpetra finds the graphs of the results there and fills in values only.
  Tpetra::MatrixMatrix::Multiply(*A_, false, *P_, false, *AP_);
  Tpetra::MatrixMatrix::Multiply(*R_, false, *AP_, false, *RAP_);
  if (stabilisation_factor_ != 1.0) scale_stabilisation();
}

void GalerkinProduct::scale_stabilisation() {
  const auto domain = RAP_->getDomainMap(), range = RAP_->getRangeMap();
  RAP_->resumeFill();
  {
    const auto local = RAP_->getLocalMatrixHost();
    for (int i = 0; i < local.numRows(); ++i) {
      if (!numbering_.is_scalar(RAP_->getRowMap()->getGlobalElement(i))) continue;
      auto row = local.row(i);
      for (int k = 0; k < row.length; ++k)
        if (numbering_.is_scalar(RAP_->getColMap()->getGlobalElement(row.colidx(k))))
          row.value(k) *= stabilisation_factor_;
    }
  }
  RAP_->fillComplete(domain, range);
}

}  // namespace tunica::multigrid
