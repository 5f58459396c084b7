#include "tunica/algebra/block_vector.hpp"

#include <cmath>

namespace tunica::algebra {

BlockVector::BlockVector(BlockSpacePtr space) : space_(std::move(space)) {
  for (int b = 0; b < space_->n_blocks(); ++b)
    blocks_.push_back(Teuchos::rcp(new Vector((*space_)[b].map)));
}

void BlockVector::assign(const BlockVector& other) {
  for (int b = 0; b < n_blocks(); ++b) blocks_[b]->assign(other[b]);
}

void BlockVector::set_zero() {
  for (const Teuchos::RCP<Vector>& block : blocks_) block->putScalar(0.0);
}

double norm(const BlockVector& x) {
  double sum = 0.0;
  for (int b = 0; b < x.n_blocks(); ++b) {
    const double of_block = x[b].norm2();
    sum += of_block * of_block;
  }
  return std::sqrt(sum);
}

}  // namespace tunica::algebra
