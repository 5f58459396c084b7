#include "linear/concatenated.hpp"

#include <stdexcept>

namespace tunica::linear {

namespace {

Teuchos::RCP<const Map> concatenated_map(const fields::FieldMesh& mesh) {
  const auto unknown = Teuchos::OrdinalTraits<Tpetra::global_size_t>::invalid();
  return Teuchos::rcp(new Map(unknown, static_cast<std::size_t>(4) * mesh.n_owned, 0, mesh.comm));
}

}  // namespace

Concatenation::Concatenation(const fields::FieldMesh& mesh)
    : map_(concatenated_map(mesh)), vector_map_(mesh.vector_map), scalar_map_(mesh.node_map) {}

Teuchos::RCP<MultiVector> Concatenation::vector_part(const MultiVector& x) const {
  return const_cast<MultiVector&>(x).offsetViewNonConst(vector_map_, 0);
}

Teuchos::RCP<MultiVector> Concatenation::scalar_part(const MultiVector& x) const {
  return const_cast<MultiVector&>(x).offsetViewNonConst(scalar_map_,
                                                        vector_map_->getNodeNumElements());
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

}  // namespace tunica::linear
