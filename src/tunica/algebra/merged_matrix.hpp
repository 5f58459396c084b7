#pragma once
#include <vector>

#include "tunica/algebra/block_matrices.hpp"
#include "tunica/algebra/dof_layout.hpp"

namespace tunica::algebra {

/// A block system as one matrix with the unknowns of a node side by side
/// (DofLayout): what incomplete and complete factorisations of the whole system and
/// mixed multigrid work on. A copy of the values; refresh() takes them over.
class MergedMatrix {
public:
  /// K must outlive the object. Collective.
  explicit MergedMatrix(const BlockMatrices& K);

  void refresh();
  Teuchos::RCP<CrsMatrix> matrix() const { return matrix_; }

  void merge(const BlockVector& x, MultiVector& merged) const;
  void split(const MultiVector& merged, BlockVector& x) const;

private:
  /// A block and the place of each of its values in the merged matrix.
  struct Block {
    const CrsMatrix* matrix;
    std::vector<int> places;
  };

  const BlockMatrices* K_;
  Teuchos::RCP<CrsMatrix> matrix_;
  std::vector<int> vector_rows_, scalar_rows_;  ///< merged local row of each row of a block
  std::vector<Block> blocks_;
};

}  // namespace tunica::algebra
