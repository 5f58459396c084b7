#pragma once
#include <vector>

#include "tunica/algebra/block_space.hpp"

namespace tunica::algebra {

/// The blocks of a merged matrix (DofLayout), as copies: MergedMatrix the other way round.
/// refresh() takes over its present values.
class SplitMatrix {
public:
  /// merged: a matrix between all unknowns of the space; it must outlive the object and keep its
  /// graph. Collective.
  SplitMatrix(const CrsMatrix& merged, const BlockSpace& space);

  void refresh();
  const Teuchos::RCP<CrsMatrix>& operator()(int row, int column) const {
    return blocks_[row * n_blocks_ + column];
  }

private:
  const CrsMatrix* merged_;
  int n_blocks_;
  std::vector<int> row_block_;  ///< of each local row of the merged matrix
  std::vector<int> column_block_;
  std::vector<Teuchos::RCP<CrsMatrix>> blocks_;
};

}  // namespace tunica::algebra
