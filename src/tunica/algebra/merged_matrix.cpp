#include "tunica/algebra/merged_matrix.hpp"

#include <algorithm>

#include "tunica/algebra/dof_layout.hpp"
#include "tunica/algebra/entry_offsets.hpp"
#include "tunica/base/trilinos.hpp"

namespace tunica::algebra {

namespace {

/// A block that is there, with its rows and columns in numbers of the whole.
struct NumberedBlock {
  const CrsMatrix* matrix;
  std::vector<GlobalOrdinal> rows, columns;

  void insert_graph(CrsMatrix& merged) const {
    const auto local = matrix->getLocalMatrixHost();
    std::vector<GlobalOrdinal> numbers;
    for (int i = 0; i < local.numRows(); ++i) {
      const auto row = local.rowConst(i);
      numbers.clear();
      for (int k = 0; k < row.length; ++k) numbers.push_back(columns[row.colidx(k)]);
      const std::vector<Scalar> zeros(numbers.size(), 0.0);
      merged.insertGlobalValues(rows[i], Teuchos::arrayViewFromVector(numbers),
                                Teuchos::arrayViewFromVector(zeros));
    }
  }
};

std::vector<NumberedBlock> numbered_blocks(const BlockMatrix& K) {
  const DofLayout layout(*K.space());
  std::vector<NumberedBlock> blocks;
  for (int i = 0; i < K.n_blocks(); ++i)
    for (int j = 0; j < K.n_blocks(); ++j)
      if (const auto& matrix = K(i, j); !matrix.is_null())
        blocks.push_back({matrix.get(), layout.merged_numbers(*matrix->getRowMap(), i),
                          layout.merged_numbers(*matrix->getColMap(), j)});
  return blocks;
}

std::size_t longest_row(const BlockMatrix& K) {
  std::size_t longest = 0;
  for (int i = 0; i < K.n_blocks(); ++i) {
    std::size_t sum = 0;
    for (int j = 0; j < K.n_blocks(); ++j)
      if (!K(i, j).is_null()) sum += longest_local_row(*K(i, j));
    longest = std::max(longest, sum);
  }
  return longest;
}

/// All values zero.
Teuchos::RCP<CrsMatrix> merged_graph(const BlockMatrix& K) {
  const auto map = DofLayout(*K.space()).merged_map(*K.space());
  const auto merged = Teuchos::rcp(new CrsMatrix(map, longest_row(K)));
  for (const NumberedBlock& block : numbered_blocks(K)) block.insert_graph(*merged);
  merged->fillComplete(map, map);
  return merged;
}

}  // namespace

MergedMatrix::MergedMatrix(const BlockMatrix& K)
    : matrix_(K.merged().is_null() ? merged_graph(K) : K.merged()),
      rows_(*K.space(), *matrix_->getRowMap()) {
  if (!K.merged().is_null()) return;
  for (const NumberedBlock& block : numbered_blocks(K))
    parts_.push_back(
        {block.matrix, entry_offsets(*block.matrix, block.rows, block.columns, *matrix_)});
}

void MergedMatrix::refresh() {
  if (parts_.empty()) return;
  matrix_->resumeFill();
  {
    const auto values = matrix_->getLocalMatrixHost().values;
    for (const Part& part : parts_) {
      const auto from = part.matrix->getLocalMatrixHost().values;
      for (std::size_t k = 0; k < part.offsets.size(); ++k) values(part.offsets[k]) = from(k);
    }
  }
  matrix_->fillComplete(matrix_->getDomainMap(), matrix_->getRangeMap());
}

}  // namespace tunica::algebra
