#include "multigrid/mixed_blocks.hpp"

#include <vector>

namespace tunica::multigrid {

namespace {

/// The entries of K in the rows and columns of one kind each.
Teuchos::RCP<CrsMatrix> block(const CrsMatrix& K, bool has_scalar_rows, bool has_scalar_columns,
                              const MixedNumbering& numbering, const Teuchos::RCP<const Map>& rows,
                              const Teuchos::RCP<const Map>& columns) {
  const auto result = Teuchos::rcp(new CrsMatrix(rows, K.getNodeMaxNumRowEntries()));
  const auto local = K.getLocalMatrixHost();
  std::vector<GlobalOrdinal> numbers;
  std::vector<Scalar> values;
  for (int i = 0; i < local.numRows(); ++i) {
    const GlobalOrdinal row_number = K.getRowMap()->getGlobalElement(i);
    if (numbering.is_scalar(row_number) != has_scalar_rows) continue;
    const auto row = local.rowConst(i);
    numbers.clear();
    values.clear();
    for (int k = 0; k < row.length; ++k) {
      const GlobalOrdinal number = K.getColMap()->getGlobalElement(row.colidx(k));
      if (numbering.is_scalar(number) != has_scalar_columns || row.value(k) == 0.0) continue;
      numbers.push_back(numbering.in_block(number));
      values.push_back(row.value(k));
    }
    result->insertGlobalValues(numbering.in_block(row_number),
                               Teuchos::arrayViewFromVector(numbers),
                               Teuchos::arrayViewFromVector(values));
  }
  result->fillComplete(columns, rows);
  return result;
}

}  // namespace

MixedBlocks mixed_blocks(const CrsMatrix& K, const MixedNumbering& numbering) {
  const Map& rows = *K.getRowMap();
  const auto u = numbering.vector_map(rows), p = numbering.scalar_map(rows);
  MixedBlocks blocks;
  blocks.B1T = block(K, false, true, numbering, u, p);
  blocks.B2 = block(K, true, false, numbering, p, u);
  blocks.mC = block(K, true, true, numbering, p, p);
  for (int i = 0; i < static_cast<int>(rows.getNodeNumElements()); ++i)
    (numbering.is_scalar(rows.getGlobalElement(i)) ? blocks.scalar_rows : blocks.vector_rows)
        .push_back(i);
  Vector all(K.getRowMap());
  K.getLocalDiagCopy(all);
  blocks.diagonal = Teuchos::rcp(new Vector(u));
  const auto from = all.getLocalViewHost(read_only);
  const auto to = blocks.diagonal->getLocalViewHost(overwrite_all);
  for (std::size_t i = 0; i < to.extent(0); ++i) to(i, 0) = from(blocks.vector_rows[i], 0);
  return blocks;
}

void split(const MixedBlocks& blocks, const MultiVector& all, Vector& u, Vector& p) {
  const auto from = all.getLocalViewHost(read_only);
  const auto to_u = u.getLocalViewHost(overwrite_all), to_p = p.getLocalViewHost(overwrite_all);
  for (std::size_t i = 0; i < to_u.extent(0); ++i) to_u(i, 0) = from(blocks.vector_rows[i], 0);
  for (std::size_t i = 0; i < to_p.extent(0); ++i) to_p(i, 0) = from(blocks.scalar_rows[i], 0);
}

void add(const MixedBlocks& blocks, Scalar factor, const Vector& u, const Vector& p,
         MultiVector& all) {
  const auto from_u = u.getLocalViewHost(read_only), from_p = p.getLocalViewHost(read_only);
  const auto to = all.getLocalViewHost(read_write);
  for (std::size_t i = 0; i < from_u.extent(0); ++i)
    to(blocks.vector_rows[i], 0) += factor * from_u(i, 0);
  for (std::size_t i = 0; i < from_p.extent(0); ++i)
    to(blocks.scalar_rows[i], 0) += factor * from_p(i, 0);
}

}  // namespace tunica::multigrid
