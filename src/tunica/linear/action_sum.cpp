#include "tunica/linear/action_sum.hpp"

#include <stdexcept>

namespace tunica::linear {

ActionSum::ActionSum(const Teuchos::RCP<const Operator>& A, const algebra::BlockMatrix& K,
                     Gather gather, Scatter scatter)
    : A_(A), L_(K.action()), gather_(std::move(gather)), scatter_(std::move(scatter)),
      x_(K.space()), y_(K.space()) {}

void ActionSum::apply(const MultiVector& X, MultiVector& Y, Teuchos::ETransp mode, Scalar alpha,
                      Scalar beta) const {
  if (mode != Teuchos::NO_TRANS) throw std::logic_error("ActionSum: no transpose");
  A_->apply(X, Y, mode, alpha, beta);
  MultiVector product(Y.getMap(), 1);
  for (std::size_t j = 0; j < X.getNumVectors(); ++j) {
    scatter_(*X.getVector(j), x_);
    y_.set_zero();
    L_->add(x_, y_);
    gather_(y_, product);
    Y.getVectorNonConst(j)->update(alpha, *product.getVector(0), 1.0);
  }
}

}  // namespace tunica::linear
