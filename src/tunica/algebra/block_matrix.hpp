#pragma once
#include "tunica/algebra/block_action.hpp"
#include "tunica/algebra/low_rank.hpp"

namespace tunica::algebra {

/// A square matrix of blocks over a BlockSpace, whoever assembled it. Blocks may be missing: they
/// are zero. A saddle-point system has the blocks
///
///   K = [ A   B1ᵀ ]      K(0, 0) = A    K(0, 1) = B1ᵀ
///       [ B2  −C  ]      K(1, 0) = B2   K(1, 1) = −C
///
/// It is stored block by block, or as one matrix with the unknowns of a node side by side
/// (DofLayout), which takes half the room where solvers want that one. Blocks are copies then, made
/// when they are first asked for.
///
/// Beside the blocks there may be a part of low rank, and one of which only the products are known.
/// Matrices and those parts are shared, so that one who holds them sees their values change.
class BlockMatrix {
public:
  BlockMatrix() = default;
  /// All blocks missing.
  explicit BlockMatrix(BlockSpacePtr space);

  const BlockSpacePtr& space() const { return space_; }
  int n_blocks() const { return space_->n_blocks(); }
  CommPtr comm() const { return space_->comm(); }
  long long n_unknowns() const { return space_->n_unknowns(); }

  /// Null: missing. Rows and domain of a matrix are the maps of its blocks.
  void set(int row, int column, const Teuchos::RCP<CrsMatrix>& matrix);
  /// If K is stored as one matrix, the first call copies all blocks, which values_changed() updates
  /// from then on; that call is collective.
  const Teuchos::RCP<CrsMatrix>& operator()(int row, int column) const;

  /// Stores K as this matrix between all unknowns, in place of blocks.
  void store_merged(const Teuchos::RCP<CrsMatrix>& merged);
  /// Null: stored block by block.
  Teuchos::RCP<CrsMatrix> merged() const;
  /// To be called when merged() has new values: takes them to the blocks that are copies.
  void values_changed() const;

  /// Gives K a part of low rank, zero at first; before anything is built upon K.
  void make_low_rank(int rank) { low_rank_ = std::make_shared<LowRank>(space_, rank); }
  /// Gives it one whose values others set; null: none.
  void share_low_rank(std::shared_ptr<LowRank> products) { low_rank_ = std::move(products); }
  /// Null: none.
  const std::shared_ptr<LowRank>& low_rank() const { return low_rank_; }

  /// Gives K a part that has no entries; before anything is built upon K.
  void set_action(std::shared_ptr<const BlockAction> action) { action_ = std::move(action); }
  /// Null: none.
  const std::shared_ptr<const BlockAction>& action() const { return action_; }

  BlockVector zero() const { return BlockVector(space_); }

  /// y = K x, all of it.
  void apply(const BlockVector& x, BlockVector& y) const;
  /// y_i = α Σ_j K_ij x_j + β y_i for the parts of longer vectors, of the blocks alone.
  void apply_blocks(const std::vector<Teuchos::RCP<MultiVector>>& x,
                    const std::vector<Teuchos::RCP<MultiVector>>& y, Scalar alpha,
                    Scalar beta) const;

private:
  struct Merged;  ///< the matrix, and what is made of it

  void apply_merged(const BlockVector& x, BlockVector& y) const;

  BlockSpacePtr space_;
  std::vector<Teuchos::RCP<CrsMatrix>> blocks_;  ///< null where K is stored as one matrix
  std::shared_ptr<Merged> merged_;               ///< null where it is not
  std::shared_ptr<LowRank> low_rank_;
  std::shared_ptr<const BlockAction> action_;
};

}  // namespace tunica::algebra
