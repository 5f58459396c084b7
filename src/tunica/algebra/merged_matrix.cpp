#include "tunica/algebra/merged_matrix.hpp"

#include <algorithm>

#include "tunica/algebra/dof_layout.hpp"
#include "tunica/algebra/entry_offsets.hpp"
#include "tunica/algebra/static_matrix.hpp"
#include "tunica/base/trilinos.hpp"

namespace tunica::algebra {

namespace {

/// A block that is there, with its rows and columns in numbers of the whole.
struct NumberedBlock {
  const CrsMatrix* matrix;
  std::vector<GlobalOrdinal> rows, columns;
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

/// All values zero. Rows of a block follow each other as they are merged, each with its columns in
/// the order of those: a row of the whole is a few runs that ascend.
Teuchos::RCP<CrsMatrix> merged_graph(const BlockMatrix& K) {
  const std::vector<NumberedBlock> blocks = numbered_blocks(K);
  const auto map = DofLayout(*K.space()).merged_map(*K.space());
  std::vector<GlobalOrdinal> reached;
  for (const NumberedBlock& block : blocks)
    reached.insert(reached.end(), block.columns.begin(), block.columns.end());
  const auto with_ghosts = map_with_ghosts(std::move(reached), map);
  const std::size_t n = global_numbers(*map).size();
  std::vector<std::vector<int>> rows, columns;  // of each block
  RowStart row_start("row start", n + 1);
  for (const NumberedBlock& block : blocks) {
    rows.push_back(local_numbers(block.rows, *map));
    columns.push_back(local_numbers(block.columns, *with_ghosts));
    const auto local = block.matrix->getLocalMatrixHost();
    for (int i = 0; i < local.numRows(); ++i)
      row_start(rows.back()[i] + 1) += local.rowConst(i).length;
  }
  for (std::size_t i = 0; i < n; ++i) row_start(i + 1) += row_start(i);
  LocalColumns merged("columns", row_start(n));
  std::vector<std::size_t> end(row_start.data(), row_start.data() + n);
  for (std::size_t b = 0; b < blocks.size(); ++b) {
    const auto local = blocks[b].matrix->getLocalMatrixHost();
    for (int i = 0; i < local.numRows(); ++i) {
      const auto row = local.rowConst(i);
      int *const first = merged.data() + row_start(rows[b][i]), *const middle =
                                                                    merged.data() + end[rows[b][i]];
      int* last = middle;
      for (int k = 0; k < row.length; ++k) *last++ = columns[b][row.colidx(k)];
      if (!std::is_sorted(middle, last)) std::sort(middle, last);
      std::inplace_merge(first, middle, last);
      end[rows[b][i]] += row.length;
    }
  }
  return matrix_on(static_graph(map, with_ghosts, row_start, merged, map));
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
