#include "tunica/algebra/split_matrix.hpp"

#include <stdexcept>

#include "tunica/algebra/dof_layout.hpp"
#include "tunica/algebra/static_matrix.hpp"
#include "tunica/base/map_of.hpp"
#include "tunica/base/trilinos.hpp"

namespace tunica::algebra {

namespace {

/// Where the unknowns that a map has belong: the block, and the place among the map's of that
/// block.
struct Places {
  std::vector<int> block, place;
  std::vector<std::vector<GlobalOrdinal>> numbers;  ///< of each block's, in the block

  Places(const Map& merged, const DofLayout& layout) : numbers(layout.n_blocks()) {
    for (const GlobalOrdinal number : global_numbers(merged)) {
      const int b = layout.block_of(number);
      block.push_back(b);
      place.push_back(static_cast<int>(numbers[b].size()));
      numbers[b].push_back(layout.in_block(number));
    }
  }
};

void check_order(const Places& rows, const BlockSpace& space) {
  for (int b = 0; b < space.n_blocks(); ++b)
    for (std::size_t r = 0; r < rows.numbers[b].size(); ++r)
      if (space[b].map->getLocalElement(rows.numbers[b][r]) != static_cast<int>(r))
        throw std::logic_error("SplitMatrix: block \"" + space[b].name +
                               "\" has its rows in another order");
}

/// The graphs of all blocks, row by row of them.
struct Graphs {
  std::vector<RowStart> row_start;
  std::vector<LocalColumns> columns;

  Graphs(const CrsMatrix& merged, const Places& rows, const Places& of_columns, int n_blocks) {
    const auto from = merged.getLocalMatrixHost().graph;
    for (int i = 0; i < n_blocks; ++i)
      for (int j = 0; j < n_blocks; ++j)
        row_start.emplace_back("row start", rows.numbers[i].size() + 1);
    const auto for_each_entry = [&](const auto& work) {
      const int n_rows = static_cast<int>(rows.block.size());
      for (int r = 0; r < n_rows; ++r)
        for (auto k = from.row_map(r); k < from.row_map(r + 1); ++k) {
          const int c = from.entries(k);
          work(n_blocks * rows.block[r] + of_columns.block[c], rows.place[r], of_columns.place[c]);
        }
    };
    for_each_entry([&](int block, int row, int) { ++row_start[block](row + 1); });
    std::vector<std::size_t> next(row_start.size(), 0);
    for (const RowStart& start : row_start) {
      for (std::size_t r = 1; r < start.extent(0); ++r) start(r) += start(r - 1);
      columns.emplace_back("columns", start(start.extent(0) - 1));
    }
    for_each_entry([&](int block, int, int column) { columns[block](next[block]++) = column; });
  }
};

}  // namespace

SplitMatrix::SplitMatrix(const CrsMatrix& merged, const BlockSpace& space)
    : merged_(&merged), n_blocks_(space.n_blocks()) {
  const DofLayout layout(space);
  const Places rows(*merged.getRowMap(), layout), columns(*merged.getColMap(), layout);
  row_block_ = rows.block;
  column_block_ = columns.block;
  check_order(rows, space);
  const Graphs graphs(merged, rows, columns, n_blocks_);
  std::vector<Teuchos::RCP<const Map>> column_maps;
  for (int j = 0; j < n_blocks_; ++j)
    column_maps.push_back(map_of(columns.numbers[j], space.comm()));
  for (int i = 0; i < n_blocks_; ++i)
    for (int j = 0; j < n_blocks_; ++j) {
      const int b = n_blocks_ * i + j;
      blocks_.push_back(matrix_on(static_graph(space[i].map, column_maps[j], graphs.row_start[b],
                                               graphs.columns[b], space[j].map)));
    }
  refresh();
}

void SplitMatrix::refresh() {
  const auto from = merged_->getLocalMatrixHost();
  std::vector<CrsMatrix::local_matrix_host_type::values_type> to;
  for (const auto& block : blocks_) {
    block->resumeFill();
    to.push_back(block->getLocalMatrixHost().values);
  }
  std::vector<std::size_t> next(blocks_.size(), 0);
  for (int r = 0; r < from.numRows(); ++r) {
    const auto row = from.rowConst(r);
    for (int k = 0; k < row.length; ++k) {
      const int b = n_blocks_ * row_block_[r] + column_block_[row.colidx(k)];
      to[b](next[b]++) = row.value(k);
    }
  }
  to.clear();
  for (const auto& block : blocks_)
    block->fillComplete(block->getDomainMap(), block->getRangeMap());
}

}  // namespace tunica::algebra
