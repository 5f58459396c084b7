#include "multigrid/mixed_blocks.hpp"

#include <stdexcept>
#include <string>
#include <vector>

#include "base/agreement.hpp"

namespace tunica::multigrid {

namespace {

/// Number of a row or column of K in its block.
GlobalOrdinal in_block(GlobalOrdinal number) {
  return number % 4 == 3 ? number / 4 : number / 4 * 3 + number % 4;
}

Teuchos::RCP<const Map> block_map(const Map& all, bool is_pressure) {
  std::vector<GlobalOrdinal> numbers;
  for (const GlobalOrdinal number : all.getNodeElementList())
    if ((number % 4 == 3) == is_pressure) numbers.push_back(in_block(number));
  const auto unknown = Teuchos::OrdinalTraits<Tpetra::global_size_t>::invalid();
  return Teuchos::rcp(new Map(unknown, Teuchos::arrayViewFromVector(numbers), 0, all.getComm()));
}

/// The entries of K in the rows and columns of one kind each.
Teuchos::RCP<CrsMatrix> block(const CrsMatrix& K, bool has_pressure_rows, bool has_pressure_columns,
                              const Teuchos::RCP<const Map>& rows,
                              const Teuchos::RCP<const Map>& columns) {
  const auto result = Teuchos::rcp(new CrsMatrix(rows, K.getNodeMaxNumRowEntries()));
  const auto local = K.getLocalMatrixHost();
  std::vector<GlobalOrdinal> numbers;
  std::vector<Scalar> values;
  for (int i = 0; i < local.numRows(); ++i) {
    const GlobalOrdinal row_number = K.getRowMap()->getGlobalElement(i);
    if ((row_number % 4 == 3) != has_pressure_rows) continue;
    const auto row = local.rowConst(i);
    numbers.clear();
    values.clear();
    for (int k = 0; k < row.length; ++k) {
      const GlobalOrdinal number = K.getColMap()->getGlobalElement(row.colidx(k));
      if ((number % 4 == 3) != has_pressure_columns || row.value(k) == 0.0) continue;
      numbers.push_back(in_block(number));
      values.push_back(row.value(k));
    }
    result->insertGlobalValues(in_block(row_number), Teuchos::arrayViewFromVector(numbers),
                               Teuchos::arrayViewFromVector(values));
  }
  result->fillComplete(columns, rows);
  return result;
}

}  // namespace

void check_mixed(const CrsMatrix& K) {
  const Map& rows = *K.getRowMap();
  const std::size_t n = rows.getNodeNumElements();
  bool is_mixed = n % 4 == 0;
  for (std::size_t i = 0; is_mixed && i < n; ++i)
    is_mixed = rows.getGlobalElement(static_cast<int>(i)) % 4 == static_cast<int>(i % 4);
  const std::string problem =
      agreed_message(*rows.getComm(),
                     is_mixed ? "" : "a smoother for mixed matrices needs four unknowns per node");
  if (!problem.empty()) throw std::runtime_error(problem);
}

MixedBlocks mixed_blocks(const CrsMatrix& K) {
  const auto u = block_map(*K.getRowMap(), false), p = block_map(*K.getRowMap(), true);
  MixedBlocks blocks;
  blocks.B1T = block(K, false, true, u, p);
  blocks.B2 = block(K, true, false, p, u);
  blocks.mC = block(K, true, true, p, p);
  Vector all(K.getRowMap());
  K.getLocalDiagCopy(all);
  blocks.diagonal = Teuchos::rcp(new Vector(u));
  const auto from = all.getLocalViewHost(read_only);
  const auto to = blocks.diagonal->getLocalViewHost(overwrite_all);
  std::size_t next = 0;
  for (std::size_t i = 0; i < from.extent(0); ++i)
    if (K.getRowMap()->getGlobalElement(static_cast<int>(i)) % 4 != 3) to(next++, 0) = from(i, 0);
  return blocks;
}

void split(const MultiVector& all, Vector& u, Vector& p) {
  const auto from = all.getLocalViewHost(read_only);
  const auto to_u = u.getLocalViewHost(overwrite_all), to_p = p.getLocalViewHost(overwrite_all);
  for (std::size_t a = 0; a < to_p.extent(0); ++a) {
    for (int i = 0; i < 3; ++i) to_u(3 * a + i, 0) = from(4 * a + i, 0);
    to_p(a, 0) = from(4 * a + 3, 0);
  }
}

void add(Scalar factor, const Vector& u, const Vector& p, MultiVector& all) {
  const auto from_u = u.getLocalViewHost(read_only), from_p = p.getLocalViewHost(read_only);
  const auto to = all.getLocalViewHost(read_write);
  for (std::size_t a = 0; a < from_p.extent(0); ++a) {
    for (int i = 0; i < 3; ++i) to(4 * a + i, 0) += factor * from_u(3 * a + i, 0);
    to(4 * a + 3, 0) += factor * from_p(a, 0);
  }
}

}  // namespace tunica::multigrid
