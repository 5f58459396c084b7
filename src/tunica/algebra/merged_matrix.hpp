#pragma once
#include <vector>

#include "tunica/algebra/block_matrix.hpp"
#include "tunica/algebra/merged_rows.hpp"

namespace tunica::algebra {

/// A matrix of blocks as one matrix with the unknowns of a node side by side (DofLayout): what
/// incomplete and complete factorisations of the whole system and mixed multigrid work on. That of
/// K, where K is stored so; else a copy of the values, and refresh() takes them over. The part of
/// low rank, if K has one, is left out.
class MergedMatrix {
public:
  /// K must outlive the object. Collective.
  explicit MergedMatrix(const BlockMatrix& K);

  void refresh();
  Teuchos::RCP<CrsMatrix> matrix() const { return matrix_; }

  void merge(const BlockVector& x, MultiVector& merged) const { rows_.merge(x, merged); }
  void split(const MultiVector& merged, BlockVector& x) const { rows_.split(merged, x); }

private:
  /// A block that is there, and where each of its values stands in the merged matrix.
  struct Part {
    const CrsMatrix* matrix;
    std::vector<int> offsets;
  };

  Teuchos::RCP<CrsMatrix> matrix_;
  std::vector<Part> parts_;  ///< none where the matrix is that of K
  MergedRows rows_;
};

}  // namespace tunica::algebra
