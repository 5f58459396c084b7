#include "tunica/algebra/block_matrices.hpp"

namespace tunica::algebra {

void BlockMatrices::apply(const BlockVector& x, BlockVector& y) const {
  A->apply(*x.u, *y.u);
  B1T->apply(*x.p, *y.u, Teuchos::NO_TRANS, 1.0, 1.0);  // y_u = A x_u + B1ᵀ x_p
  B2->apply(*x.u, *y.p);
  mC->apply(*x.p, *y.p, Teuchos::NO_TRANS, 1.0, 1.0);  // y_p = B2 x_u − C x_p
}

}  // namespace tunica::algebra
