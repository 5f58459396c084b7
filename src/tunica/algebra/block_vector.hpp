#pragma once
#include "tunica/algebra/block_space.hpp"

namespace tunica::algebra {

/// Unknowns, residuals or increments: a vector for each block of a space. A copy shares the
/// storage; assign() copies values.
class BlockVector {
public:
  BlockVector() = default;
  /// Zeros.
  explicit BlockVector(BlockSpacePtr space);
  /// The given vectors, one per block.
  BlockVector(BlockSpacePtr space, std::vector<Teuchos::RCP<Vector>> blocks)
      : space_(std::move(space)), blocks_(std::move(blocks)) {}

  const BlockSpacePtr& space() const { return space_; }
  int n_blocks() const { return static_cast<int>(blocks_.size()); }

  Vector& operator[](int b) { return *blocks_[b]; }
  const Vector& operator[](int b) const { return *blocks_[b]; }
  /// The block of that name. Throws std::invalid_argument for an unknown one.
  Vector& operator[](const std::string& name) { return *blocks_[space_->index_of(name)]; }
  const Vector& operator[](const std::string& name) const {
    return *blocks_[space_->index_of(name)];
  }
  Teuchos::RCP<Vector> block(int b) { return blocks_[b]; }
  Teuchos::RCP<const Vector> block(int b) const { return blocks_[b]; }

  void assign(const BlockVector& other);
  void set_zero();

private:
  BlockSpacePtr space_;
  std::vector<Teuchos::RCP<Vector>> blocks_;
};

/// |x| over all blocks. Collective.
double norm(const BlockVector& x);

}  // namespace tunica::algebra
