#include "tunica/multigrid/galerkin/galerkin_product.hpp"

#include <Tpetra_RowMatrixTransposer.hpp>

#include "tunica/algebra/without_pattern.hpp"
#include "tunica/base/trilinos.hpp"
#include "tunica/multigrid/galerkin/least_stabilisation.hpp"

namespace tunica::multigrid {

namespace {

/// R = Pᵀ, by products with a vector without pattern. Collective.
bool is_transpose(const CrsMatrix& R, const CrsMatrix& P) {
  if (!R.getDomainMap()->isSameAs(*P.getRangeMap()) ||
      !R.getRangeMap()->isSameAs(*P.getDomainMap()))
    return false;
  Vector x(R.getDomainMap()), Rx(R.getRangeMap()), Ptx(R.getRangeMap());
  algebra::fill_without_pattern(x);
  R.apply(x, Rx);
  P.apply(x, Ptx, Teuchos::TRANS);
  Rx.update(-1.0, Ptx, 1.0);
  return Rx.normInf() <= 1e-12 * Ptx.normInf();
}

}  // namespace

GalerkinProduct::GalerkinProduct(const Teuchos::RCP<const CrsMatrix>& R,
                                 const Teuchos::RCP<const CrsMatrix>& A,
                                 const Teuchos::RCP<const CrsMatrix>& P,
                                 const algebra::DofLayout& numbering,
                                 const Stabilisation& stabilisation)
    : R_(R), P_(P),
      stabilised_(stabilisation.schur > 0.0
                      ? std::make_unique<SchurStabilised>(A, numbering, stabilisation.schur)
                      : nullptr),
      A_(A), numbering_(numbering), stabilisation_(stabilisation) {
  if (stabilised_) A_ = stabilised_->matrix();
  // Pᵀ A P in one go saves the storage of A P.
  if (algebra::TripleProduct::serves(*A_, *P) && (R_.is_null() || is_transpose(*R_, *P))) {
    triple_.emplace(*A_, *P);
  } else {
    if (R_.is_null())
      R_ = Tpetra::RowMatrixTransposer<Scalar, LocalOrdinal, GlobalOrdinal, Node>(
               Teuchos::rcp_const_cast<CrsMatrix>(P_))
               .createTranspose();
    AP_.emplace(*A_, *P);
    RAP_.emplace(*R_, *AP_->matrix());
  }
  take_values();
}

// R A P, with R = Pᵀ without the product between
void GalerkinProduct::take_values() {
  if (triple_) {
    triple_->refresh();
  } else {
    AP_->refresh();
    RAP_->refresh();
  }
  if (stabilisation_.factor != 1.0) scale_stabilisation();
  if (stabilisation_.least > 0.0)
    enlarge_stabilisation(*matrix(), numbering_, stabilisation_.least);
}

void GalerkinProduct::refresh() {
  if (stabilised_) stabilised_->refresh();
  take_values();
}

// −C ← −σ C, the block of the scalars
void GalerkinProduct::scale_stabilisation() {
  CrsMatrix& K = *matrix();
  const auto domain = K.getDomainMap(), range = K.getRangeMap();
  K.resumeFill();
  {
    const auto local = K.getLocalMatrixHost();
    for (int i = 0; i < local.numRows(); ++i) {
      if (!numbering_.is_scalar(K.getRowMap()->getGlobalElement(i))) continue;
      auto row = local.row(i);
      for (int k = 0; k < row.length; ++k)
        if (numbering_.is_scalar(K.getColMap()->getGlobalElement(row.colidx(k))))
          row.value(k) *= stabilisation_.factor;
    }
  }
  K.fillComplete(domain, range);
}

}  // namespace tunica::multigrid
