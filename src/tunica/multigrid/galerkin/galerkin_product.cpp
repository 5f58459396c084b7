#include "tunica/multigrid/galerkin/galerkin_product.hpp"

namespace tunica::multigrid {

GalerkinProduct::GalerkinProduct(const Teuchos::RCP<const CrsMatrix>& R,
                                 const Teuchos::RCP<const CrsMatrix>& A,
                                 const Teuchos::RCP<const CrsMatrix>& P,
                                 const algebra::DofLayout& numbering, double stabilisation_factor)
    : R_(R), A_(A), P_(P), numbering_(numbering), stabilisation_factor_(stabilisation_factor),
      AP_(*A, *P), RAP_(*R, *AP_.matrix()) {
  refresh();
}

void GalerkinProduct::refresh() {
  AP_.refresh();
  RAP_.refresh();
  if (stabilisation_factor_ != 1.0) scale_stabilisation();
}

void GalerkinProduct::scale_stabilisation() {
  CrsMatrix& K = *RAP_.matrix();
  const auto domain = K.getDomainMap(), range = K.getRangeMap();
  K.resumeFill();
  {
    const auto local = K.getLocalMatrixHost();
    for (int i = 0; i < local.numRows(); ++i) {
      if (!numbering_.is_scalar(K.getRowMap()->getGlobalElement(i))) continue;
      auto row = local.row(i);
      for (int k = 0; k < row.length; ++k)
        if (numbering_.is_scalar(K.getColMap()->getGlobalElement(row.colidx(k))))
          row.value(k) *= stabilisation_factor_;
    }
  }
  K.fillComplete(domain, range);
}

}  // namespace tunica::multigrid
