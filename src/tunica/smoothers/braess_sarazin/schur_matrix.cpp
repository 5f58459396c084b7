#include "tunica/smoothers/braess_sarazin/schur_matrix.hpp"

#include <TpetraExt_MatrixMatrix.hpp>

#include "tunica/algebra/entry_offsets.hpp"

namespace tunica::smoothers {

namespace {

void add(double factor, const CrsMatrix& part, const std::vector<int>& places, CrsMatrix& whole) {
  const auto from = part.getLocalMatrixHost().values;
  const auto to = whole.getLocalMatrixHost().values;
  for (std::size_t k = 0; k < places.size(); ++k) to(places[k]) += factor * from(k);
}

/// The graph of both.
Teuchos::RCP<CrsMatrix> sum_of_graphs(const CrsMatrix& A, const CrsMatrix& B) {
  return Tpetra::MatrixMatrix::add(1.0, false, A, 1.0, false, B, B.getDomainMap(), B.getRangeMap());
}

}  // namespace

// S has the graphs of B2 D⁻¹ B1ᵀ and of C together, found once, and places in it for the values of
// both.
SchurMatrix::SchurMatrix(const CrsMatrix& B1T, const CrsMatrix& B2, const CrsMatrix& mC,
                         const Vector& inverse_D)
    : B1T_(&B1T), mC_(&mC), scaled_(B1T, Teuchos::Copy), product_(B2, scaled_),
      S_(sum_of_graphs(*product_.matrix(), mC)),
      places_of_product_(algebra::entry_offsets(*product_.matrix(), *S_)),
      places_of_mC_(algebra::entry_offsets(mC, *S_)) {
  refresh(inverse_D);
}

void SchurMatrix::refresh(const Vector& inverse_D) {
  // D⁻¹ B1ᵀ
  scaled_.resumeFill();
  {
    const auto from = B1T_->getLocalMatrixHost().values;
    const auto to = scaled_.getLocalMatrixHost().values;
    for (std::size_t k = 0; k < to.extent(0); ++k) to(k) = from(k);
  }
  scaled_.fillComplete(scaled_.getDomainMap(), scaled_.getRangeMap());
  scaled_.leftScale(inverse_D);
  product_.refresh();
  // S = B2 (D⁻¹ B1ᵀ) − (−C)
  const auto domain = S_->getDomainMap(), range = S_->getRangeMap();
  S_->resumeFill();
  S_->setAllToScalar(0.0);
  add(1.0, *product_.matrix(), places_of_product_, *S_);
  add(-1.0, *mC_, places_of_mC_, *S_);
  S_->fillComplete(domain, range);
}

}  // namespace tunica::smoothers
