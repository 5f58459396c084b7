#include "multigrid/schur_matrix.hpp"

#include <TpetraExt_MatrixMatrix.hpp>

#include "multigrid/value_places.hpp"

namespace tunica::multigrid {

namespace {

void add(double factor, const CrsMatrix& part, const std::vector<int>& places, CrsMatrix& whole) {
  const auto from = part.getLocalMatrixHost().values;
  const auto to = whole.getLocalMatrixHost().values;
  for (std::size_t k = 0; k < places.size(); ++k) to(places[k]) += factor * from(k);
}

}  // namespace

SchurMatrix::SchurMatrix(const CrsMatrix& B1T, const CrsMatrix& B2, const CrsMatrix& mC,
                         const Vector& inverse_D)
    : B1T_(&B1T), B2_(&B2), mC_(&mC), scaled_(B1T, Teuchos::Copy), product_(B2.getRowMap(), 0) {
  multiply(inverse_D);
  S_ = Tpetra::MatrixMatrix::add(1.0, false, product_, -1.0, false, mC, mC.getDomainMap(),
                                 mC.getRangeMap());
}

void SchurMatrix::multiply(const Vector& inverse_D) {
  scaled_.resumeFill();
  {
    const auto from = B1T_->getLocalMatrixHost().values;
    const auto to = scaled_.getLocalMatrixHost().values;
    for (std::size_t k = 0; k < to.extent(0); ++k) to(k) = from(k);
  }
  scaled_.fillComplete(scaled_.getDomainMap(), scaled_.getRangeMap());
  scaled_.leftScale(inverse_D);
  // The second time Tpetra finds the graph of the product there and fills in values only.
  Tpetra::MatrixMatrix::Multiply(*B2_, false, scaled_, false, product_);
}

void SchurMatrix::refresh(const Vector& inverse_D) {
  if (places_of_mC_.empty() && places_of_product_.empty()) {
    places_of_product_ = value_places(product_, *S_);
    places_of_mC_ = value_places(*mC_, *S_);
  }
  multiply(inverse_D);
  const auto domain = S_->getDomainMap(), range = S_->getRangeMap();
  S_->resumeFill();
  S_->setAllToScalar(0.0);
  add(1.0, product_, places_of_product_, *S_);
  add(-1.0, *mC_, places_of_mC_, *S_);
  S_->fillComplete(domain, range);
}

}  // namespace tunica::multigrid
