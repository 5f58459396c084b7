#include "tunica/algebra/concatenation.hpp"

#include <stdexcept>

#include "tunica/base/trilinos.hpp"

namespace tunica::algebra {

namespace {

Teuchos::RCP<const Map> concatenated_map(const Map& vectors, const Map& scalars) {
  const auto unknown = Teuchos::OrdinalTraits<Tpetra::global_size_t>::invalid();
  return Teuchos::rcp(new Map(unknown, n_local(vectors) + n_local(scalars), 0, vectors.getComm()));
}

}  // namespace

Concatenation::Concatenation(const Teuchos::RCP<const Map>& vectors,
                             const Teuchos::RCP<const Map>& scalars)
    : map_(concatenated_map(*vectors, *scalars)), vector_map_(vectors), scalar_map_(scalars) {}

Teuchos::RCP<MultiVector> Concatenation::vector_part(const MultiVector& x) const {
  return const_cast<MultiVector&>(x).offsetViewNonConst(vector_map_, 0);
}

Teuchos::RCP<MultiVector> Concatenation::scalar_part(const MultiVector& x) const {
  return const_cast<MultiVector&>(x).offsetViewNonConst(scalar_map_, n_local(*vector_map_));
}

void ConcatenatedOperator::apply(const MultiVector& X, MultiVector& Y, Teuchos::ETransp mode,
                                 Scalar alpha, Scalar beta) const {
  if (mode != Teuchos::NO_TRANS) throw std::logic_error("ConcatenatedOperator: no transpose");
  const auto xu = blocks_.vector_part(X), xp = blocks_.scalar_part(X);
  const auto yu = blocks_.vector_part(Y), yp = blocks_.scalar_part(Y);
  K_->A->apply(*xu, *yu, mode, alpha, beta);
  K_->B1T->apply(*xp, *yu, mode, alpha, 1.0);
  K_->B2->apply(*xu, *yp, mode, alpha, beta);
  K_->mC->apply(*xp, *yp, mode, alpha, 1.0);
}

}  // namespace tunica::algebra
