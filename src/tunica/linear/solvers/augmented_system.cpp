#include "tunica/linear/solvers/augmented_system.hpp"

namespace tunica::linear {

// K = A + W S Vᵀ + L: entries, products of vectors, and what has no entries at all. Inverses have
// the products, too; L is in the matrix only.
AugmentedSystem::AugmentedSystem(const algebra::BlockMatrix& K,
                                 const Teuchos::RCP<const Operator>& A,
                                 const ActionSum::Gather& gather, const ActionSum::Scatter& scatter)
    : A_(A) {
  if (K.low_rank()) {
    const LowRankForm form(K, A->getRangeMap(), gather);
    sum_ = Teuchos::rcp(new LowRankSum(A, form));
    sum_inverse_ = Teuchos::rcp(new LowRankInverse(form));
  }
  if (K.action()) whole_ = Teuchos::rcp(new ActionSum(matrix(), K, gather, scatter));
}

Teuchos::RCP<const Operator> AugmentedSystem::matrix() const {
  if (!whole_.is_null()) return whole_;
  return matrix_with_low_rank();
}

Teuchos::RCP<const Operator> AugmentedSystem::matrix_with_low_rank() const {
  if (!sum_.is_null()) return sum_;
  return A_;
}

void AugmentedSystem::refresh_matrix() {
  if (!sum_.is_null()) sum_->refresh();
}

bool AugmentedSystem::refresh_inverse(const Teuchos::RCP<const Operator>& P_inverse,
                                      const LowRankInverse::Solve& solve) {
  return sum_inverse_.is_null() || sum_inverse_->refresh(P_inverse, solve);
}

std::vector<Vector> AugmentedSystem::solutions() const {
  return sum_inverse_.is_null() ? std::vector<Vector>() : sum_inverse_->solutions();
}

void AugmentedSystem::set_solutions(std::vector<Vector> Z) {
  if (!sum_inverse_.is_null()) sum_inverse_->set_solutions(std::move(Z));
}

// (I − Z D Vᵀ) P⁻¹ where K has products
Teuchos::RCP<const Operator> AugmentedSystem::inverse(
    const Teuchos::RCP<const Operator>& P_inverse) const {
  if (sum_inverse_.is_null() || P_inverse.is_null()) return P_inverse;
  return sum_inverse_;
}

}  // namespace tunica::linear
