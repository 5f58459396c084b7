#include "tunica/linear/action_sum.hpp"

#include <stdexcept>

namespace tunica::linear {

ActionSum::ActionSum(const Teuchos::RCP<const Operator>& A, const algebra::BlockMatrix& K,
                     Gather gather, Scatter scatter)
    : A_(A), L_(K.action()), gather_(std::move(gather)), scatter_(std::move(scatter)),
      space_(K.space()) {}

// Y ← α (A + L) X + β Y. L acts on the blocks of one column at a time.
void ActionSum::apply(const MultiVector& X, MultiVector& Y, Teuchos::ETransp mode, Scalar alpha,
                      Scalar beta) const {
  if (mode != Teuchos::NO_TRANS) throw std::logic_error("ActionSum: no transpose");
  A_->apply(X, Y, mode, alpha, beta);
  if (L_->is_zero()) return;
  algebra::BlockVector x(space_), y(space_);
  MultiVector product(Y.getMap(), 1);
  for (std::size_t j = 0; j < X.getNumVectors(); ++j) {
    scatter_(*X.getVector(j), x);
    y.set_zero();
    L_->add(x, y);
    gather_(y, product);
    Y.getVectorNonConst(j)->update(alpha, *product.getVector(0), 1.0);
  }
}

}  // namespace tunica::linear
