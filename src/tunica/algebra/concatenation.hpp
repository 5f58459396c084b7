#pragma once
#include "tunica/algebra/block_matrix.hpp"

namespace tunica::algebra {

/// All blocks of a space behind each other in one vector: on each rank the unknowns of the first
/// block, then those of the second, and so on. The blocks are views, so that Krylov methods on the
/// long vectors work on the blocks without copies.
class Concatenation {
public:
  explicit Concatenation(BlockSpacePtr space);

  const BlockSpacePtr& space() const { return space_; }
  Teuchos::RCP<const Map> map() const { return map_; }
  /// Views of the blocks of a long vector, of all its columns.
  std::vector<Teuchos::RCP<MultiVector>> parts(const MultiVector& x) const;

  /// Copies blocks into the first column of a long vector, and back.
  void gather(const BlockVector& x, MultiVector& all) const;
  void scatter(const MultiVector& all, BlockVector& x) const;

private:
  BlockSpacePtr space_;
  Teuchos::RCP<const Map> map_;
};

/// The blocks of K on concatenated vectors.
class ConcatenatedOperator : public Operator {
public:
  /// K must outlive the object.
  ConcatenatedOperator(const Concatenation& blocks, const BlockMatrix& K)
      : blocks_(blocks), K_(&K) {}

  void apply(const MultiVector& X, MultiVector& Y, Teuchos::ETransp mode = Teuchos::NO_TRANS,
             Scalar alpha = 1.0, Scalar beta = 0.0) const override;
  Teuchos::RCP<const Map> getDomainMap() const override { return blocks_.map(); }
  Teuchos::RCP<const Map> getRangeMap() const override { return blocks_.map(); }

private:
  Concatenation blocks_;
  const BlockMatrix* K_;
};

}  // namespace tunica::algebra
