#pragma once
#include <vector>

#include "tunica/algebra/block_vector.hpp"

namespace tunica::algebra {

/// Vectors whose unknowns of a node stand side by side (DofLayout), from blocks and back.
class MergedRows {
public:
  /// merged: the unknowns of all blocks of the space.
  MergedRows(const BlockSpace& space, const Map& merged);

  void merge(const BlockVector& x, MultiVector& merged) const;
  void split(const MultiVector& merged, BlockVector& x) const;

private:
  std::vector<std::vector<int>> rows_;  ///< merged local row of each row of each block
};

}  // namespace tunica::algebra
