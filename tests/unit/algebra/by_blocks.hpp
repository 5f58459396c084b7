#pragma once
#include "tunica/algebra/block_matrix.hpp"

namespace tunica::test {

/// A matrix that is stored block by block, with the blocks of another and nothing beside them.
inline algebra::BlockMatrix blocks_of(const algebra::BlockMatrix& K) {
  algebra::BlockMatrix blocks(K.space());
  for (int i = 0; i < K.n_blocks(); ++i)
    for (int j = 0; j < K.n_blocks(); ++j) blocks.set(i, j, K(i, j));
  return blocks;
}

/// y = K x with the blocks alone.
inline algebra::BlockVector product_of_blocks(const algebra::BlockMatrix& K,
                                              const algebra::BlockVector& x) {
  algebra::BlockVector y(K.space());
  for (int i = 0; i < K.n_blocks(); ++i)
    for (int j = 0; j < K.n_blocks(); ++j) K(i, j)->apply(x[j], y[i], Teuchos::NO_TRANS, 1.0, 1.0);
  return y;
}

}  // namespace tunica::test
