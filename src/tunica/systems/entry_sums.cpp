#include "tunica/systems/entry_sums.hpp"

#include <cmath>

namespace tunica::systems {

void add_magnitudes(const CrsMatrix& A, const MultiVector& x, MultiVector& y) {
  const auto importer = A.getGraph()->getImporter();
  Vector ghosted(A.getColMap());
  if (importer.is_null())
    ghosted.update(1.0, x, 0.0);
  else
    ghosted.doImport(x, *importer, insert);
  const auto from = ghosted.getLocalViewHost(read_only);
  const auto to = y.getLocalViewHost(read_write);
  const auto local = A.getLocalMatrixHost();
  for (int i = 0; i < local.numRows(); ++i) {
    const auto row = local.rowConst(i);
    for (int k = 0; k < row.length; ++k)
      to(i, 0) += std::abs(row.value(k)) * std::abs(from(row.colidx(k), 0));
  }
}

void add_column_magnitudes(const CrsMatrix& A, const MultiVector& x, MultiVector& y) {
  Vector sums(A.getColMap());
  {
    const auto from = x.getLocalViewHost(read_only);
    const auto to = sums.getLocalViewHost(read_write);
    const auto local = A.getLocalMatrixHost();
    for (int i = 0; i < local.numRows(); ++i) {
      const auto row = local.rowConst(i);
      for (int k = 0; k < row.length; ++k)
        to(row.colidx(k), 0) += std::abs(row.value(k)) * std::abs(from(i, 0));
    }
  }
  const auto importer = A.getGraph()->getImporter();
  if (importer.is_null())
    y.update(1.0, sums, 1.0);
  else
    y.doExport(sums, *importer, Tpetra::ADD);
}

}  // namespace tunica::systems
