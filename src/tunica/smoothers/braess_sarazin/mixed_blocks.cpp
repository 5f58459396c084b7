#include "tunica/smoothers/braess_sarazin/mixed_blocks.hpp"

#include <algorithm>

#include "tunica/algebra/entry_offsets.hpp"
#include "tunica/algebra/static_matrix.hpp"
#include "tunica/base/map_of.hpp"
#include "tunica/base/trilinos.hpp"

namespace tunica::smoothers {

namespace {

/// Columns of K that a block has: all of its own, and behind them those of other ranks that its
/// rows reach, in the order of K.
struct BlockColumns {
  Teuchos::RCP<const Map> map;
  std::vector<int> local;  ///< of each column of K; -1: it is not in the block
};

BlockColumns columns_of(const CrsMatrix& K, int row_block, int column_block,
                        const algebra::DofLayout& numbering,
                        const Teuchos::RCP<const Map>& columns) {
  const auto local = K.getLocalMatrixHost();
  std::vector<char> is_reached(local.numCols(), 0);
  for (int i = 0; i < local.numRows(); ++i) {
    if (numbering.block_of(K.getRowMap()->getGlobalElement(i)) != row_block) continue;
    const auto row = local.rowConst(i);
    for (int k = 0; k < row.length; ++k) is_reached[row.colidx(k)] = 1;
  }
  const auto own = global_numbers(*columns);
  std::vector<GlobalOrdinal> numbers(own.begin(), own.end());
  BlockColumns found{{}, std::vector<int>(local.numCols(), -1)};
  for (int j = 0; j < local.numCols(); ++j) {
    const GlobalOrdinal number = K.getColMap()->getGlobalElement(j);
    if (numbering.block_of(number) != column_block) continue;
    found.local[j] = columns->getLocalElement(numbering.in_block(number));
    if (found.local[j] >= 0 || is_reached[j] == 0) continue;
    found.local[j] = static_cast<int>(numbers.size());
    numbers.push_back(numbering.in_block(number));
  }
  found.map = map_of(numbers, columns->getComm());
  return found;
}

/// The entries of K in the rows and columns of one block each, all zero: values are copied by their
/// offsets with each new matrix.
Teuchos::RCP<CrsMatrix> block(const CrsMatrix& K, int row_block, int column_block,
                              const algebra::DofLayout& numbering,
                              const Teuchos::RCP<const Map>& rows,
                              const Teuchos::RCP<const Map>& columns) {
  const BlockColumns of_block = columns_of(K, row_block, column_block, numbering, columns);
  const auto local = K.getLocalMatrixHost();
  algebra::RowStart row_start("row start", global_numbers(*rows).size() + 1);
  std::vector<int> all;
  std::size_t n_rows = 0;
  for (int i = 0; i < local.numRows(); ++i) {
    if (numbering.block_of(K.getRowMap()->getGlobalElement(i)) != row_block) continue;
    const auto row = local.rowConst(i);
    const auto begin = static_cast<std::ptrdiff_t>(all.size());
    for (int k = 0; k < row.length; ++k)
      if (const int column = of_block.local[row.colidx(k)]; column >= 0) all.push_back(column);
    std::sort(all.begin() + begin, all.end());
    row_start(++n_rows) = all.size();
  }
  algebra::LocalColumns entries("columns", all.size());
  std::copy(all.begin(), all.end(), entries.data());
  return algebra::matrix_on(algebra::static_graph(rows, of_block.map, row_start, entries, columns));
}

// Where each value of a block stands among those of K.
std::vector<int> offsets(const CrsMatrix& part, int row_block, int column_block,
                         const algebra::DofLayout& numbering, const CrsMatrix& K) {
  return algebra::entry_offsets(part, numbering.merged_numbers(*part.getRowMap(), row_block),
                                numbering.merged_numbers(*part.getColMap(), column_block), K);
}

void copy(const CrsMatrix& whole, const std::vector<int>& from_offsets, CrsMatrix& part) {
  const auto domain = part.getDomainMap(), range = part.getRangeMap();
  part.resumeFill();
  {
    const auto from = whole.getLocalMatrixHost().values;
    const auto to = part.getLocalMatrixHost().values;
    for (std::size_t k = 0; k < from_offsets.size(); ++k) to(k) = from(from_offsets[k]);
  }
  part.fillComplete(domain, range);
}

}  // namespace

MixedBlocks::MixedBlocks(const CrsMatrix& K, const algebra::DofLayout& layout) : K_(&K) {
  // All scalars of a node are one block here, however many there are.
  const int components = layout.components(0);
  const algebra::DofLayout numbering({components, layout.dofs() - components});
  const Map& rows = *K.getRowMap();
  const auto u = numbering.block_map(rows, 0), p = numbering.block_map(rows, 1);
  B1T = block(K, 0, 1, numbering, u, p);
  B2 = block(K, 1, 0, numbering, p, u);
  mC = block(K, 1, 1, numbering, p, p);
  offsets_of_B1T_ = offsets(*B1T, 0, 1, numbering, K);
  offsets_of_B2_ = offsets(*B2, 1, 0, numbering, K);
  offsets_of_mC_ = offsets(*mC, 1, 1, numbering, K);
  for (int i = 0; i < static_cast<int>(n_local(rows)); ++i)
    // Rows of K by blocks, in the order of the blocks' own rows
    (numbering.is_scalar(rows.getGlobalElement(i)) ? scalar_rows_ : vector_rows_).push_back(i);
  diagonal = Teuchos::rcp(new Vector(u));
  is_uncovered.resize(vector_rows_.size());
  refresh();
}

void MixedBlocks::refresh() {
  copy(*K_, offsets_of_B1T_, *B1T);
  copy(*K_, offsets_of_B2_, *B2);
  copy(*K_, offsets_of_mC_, *mC);
  // diag(A). A row of K with nothing beside it is an eliminated one, which a sweep solves.
  const auto local = K_->getLocalMatrixHost();
  const auto D = diagonal->getLocalViewHost(overwrite_all);
  for (std::size_t i = 0; i < vector_rows_.size(); ++i) {
    const auto row = local.rowConst(vector_rows_[i]);
    const int own =
        K_->getColMap()->getLocalElement(K_->getRowMap()->getGlobalElement(vector_rows_[i]));
    D(i, 0) = 0.0;
    is_uncovered[i] = 1;
    for (int k = 0; k < row.length; ++k)
      if (row.colidx(k) == own)
        D(i, 0) = row.value(k);
      else if (row.value(k) != 0.0)
        is_uncovered[i] = 0;
  }
}

void MixedBlocks::split(const MultiVector& all, Vector& u, Vector& p) const {
  const auto from = all.getLocalViewHost(read_only);
  const auto to_u = u.getLocalViewHost(overwrite_all), to_p = p.getLocalViewHost(overwrite_all);
  for (std::size_t i = 0; i < vector_rows_.size(); ++i) to_u(i, 0) = from(vector_rows_[i], 0);
  for (std::size_t i = 0; i < scalar_rows_.size(); ++i) to_p(i, 0) = from(scalar_rows_[i], 0);
}

void MixedBlocks::add(Scalar factor, const Vector& u, const Vector& p, MultiVector& all) const {
  const auto from_u = u.getLocalViewHost(read_only), from_p = p.getLocalViewHost(read_only);
  const auto to = all.getLocalViewHost(read_write);
  for (std::size_t i = 0; i < vector_rows_.size(); ++i)
    to(vector_rows_[i], 0) += factor * from_u(i, 0);
  for (std::size_t i = 0; i < scalar_rows_.size(); ++i)
    to(scalar_rows_[i], 0) += factor * from_p(i, 0);
}

}  // namespace tunica::smoothers
