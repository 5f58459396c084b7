#include "tunica/algebra/block_matrix.hpp"

#include <optional>
#include <stdexcept>

#include "tunica/algebra/merged_rows.hpp"
#include "tunica/algebra/split_matrix.hpp"

namespace tunica::algebra {

struct BlockMatrix::Merged {
  Teuchos::RCP<CrsMatrix> matrix;
  MergedRows rows;
  std::optional<SplitMatrix> blocks;  ///< none before they are asked for
};

BlockMatrix::BlockMatrix(BlockSpacePtr space)
    : space_(std::move(space)),
      blocks_(static_cast<std::size_t>(space_->n_blocks()) * space_->n_blocks()) {}

void BlockMatrix::set(int row, int column, const Teuchos::RCP<CrsMatrix>& matrix) {
  if (!matrix.is_null() && !(matrix->getRowMap()->isSameAs(*(*space_)[row].map) &&
                             matrix->getDomainMap()->isSameAs(*(*space_)[column].map)))
    throw std::invalid_argument("BlockMatrix: the matrix for \"" + (*space_)[row].name +
                                "\" by \"" + (*space_)[column].name +
                                "\" has other rows or columns");
  if (merged_) throw std::logic_error("BlockMatrix: its blocks are copies of one matrix");
  blocks_[row * n_blocks() + column] = matrix;
}

const Teuchos::RCP<CrsMatrix>& BlockMatrix::operator()(int row, int column) const {
  if (!merged_) return blocks_[row * n_blocks() + column];
  if (!merged_->blocks) merged_->blocks.emplace(*merged_->matrix, *space_);
  return (*merged_->blocks)(row, column);
}

void BlockMatrix::store_merged(const Teuchos::RCP<CrsMatrix>& merged) {
  merged_ = std::make_shared<Merged>(
      Merged{merged, MergedRows(*space_, *merged->getRowMap()), std::nullopt});
}

Teuchos::RCP<CrsMatrix> BlockMatrix::merged() const {
  return merged_ ? merged_->matrix : Teuchos::null;
}

void BlockMatrix::values_changed() const {
  if (merged_ && merged_->blocks) merged_->blocks->refresh();
}

void BlockMatrix::apply_merged(const BlockVector& x, BlockVector& y) const {
  Vector all_x(merged_->matrix->getDomainMap()), all_y(all_x.getMap());
  merged_->rows.merge(x, all_x);
  merged_->matrix->apply(all_x, all_y);
  merged_->rows.split(all_y, y);
}

void BlockMatrix::apply(const BlockVector& x, BlockVector& y) const {
  std::vector<Teuchos::RCP<MultiVector>> from, to;
  for (int b = 0; b < n_blocks(); ++b) {
    from.push_back(Teuchos::rcp_const_cast<Vector>(x.block(b)));
    to.push_back(y.block(b));
  }
  if (merged_)
    apply_merged(x, y);
  else
    apply_blocks(from, to, 1.0, 0.0);
  if (low_rank_) low_rank_->add(from, to, 1.0);  // y ← y + W S Vᵀ x
  if (action_) action_->add(x, y);
}

void BlockMatrix::apply_blocks(const std::vector<Teuchos::RCP<MultiVector>>& x,
                               const std::vector<Teuchos::RCP<MultiVector>>& y, Scalar alpha,
                               Scalar beta) const {
  for (int i = 0; i < n_blocks(); ++i) {
    Scalar keep = beta;  // of what y_i holds: β at first, then all
    for (int j = 0; j < n_blocks(); ++j) {
      const Teuchos::RCP<CrsMatrix>& K = (*this)(i, j);
      if (K.is_null()) continue;
      K->apply(*x[j], *y[i], Teuchos::NO_TRANS, alpha, keep);  // y_i = α K_ij x_j + keep y_i
      keep = 1.0;
    }
    if (keep != 1.0) y[i]->scale(keep);  // a row without matrices
  }
}

}  // namespace tunica::algebra
