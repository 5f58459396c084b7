#pragma once
#include "tunica/base/reduce.hpp"
#include "tunica/base/types.hpp"

namespace tunica::algebra {

/// Whether no unknown is coupled with another, by entries that are not zero. Collective.
inline bool is_diagonal(const CrsMatrix& A) {
  const auto local = A.getLocalMatrixHost();
  const Map &rows = *A.getRowMap(), &columns = *A.getColMap();
  bool is = true;
  for (int i = 0; i < local.numRows() && is; ++i) {
    const auto row = local.rowConst(i);
    for (int k = 0; k < row.length; ++k)
      is = is && (row.value(k) == 0.0 ||
                  columns.getGlobalElement(row.colidx(k)) == rows.getGlobalElement(i));
  }
  return all_agree(*A.getComm(), is);
}

}  // namespace tunica::algebra
