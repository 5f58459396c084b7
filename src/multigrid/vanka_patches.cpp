#include "multigrid/vanka_patches.hpp"

#include <algorithm>

namespace tunica::multigrid {

int VankaPatches::largest() const {
  int most = 0;
  for (int p = 0; p < n_patches(); ++p) most = std::max(most, size(p));
  return most;
}

VankaPatches make_vanka_patches(const CrsMatrix& K, const std::vector<char>& is_pressure) {
  const auto local = K.getLocalMatrixHost();
  VankaPatches patches;
  std::vector<int> row_of_column(K.getColMap()->getNodeNumElements(), -1);
  for (int i = 0; i < local.numRows(); ++i) {
    const int column = K.getColMap()->getLocalElement(K.getRowMap()->getGlobalElement(i));
    patches.column_of_row.push_back(column);
    if (column >= 0) row_of_column[column] = i;
  }
  std::vector<char> is_covered(local.numRows(), 0);
  patches.start.push_back(0);
  for (int i = 0; i < local.numRows(); ++i) {
    if (!is_pressure[i]) continue;
    const auto row = local.rowConst(i);
    const std::size_t first = patches.rows.size();
    for (int k = 0; k < row.length; ++k) {
      const int j = row_of_column[row.colidx(k)];
      if (j >= 0 && !is_pressure[j] && row.value(k) != 0.0) patches.rows.push_back(j);
    }
    std::sort(patches.rows.begin() + static_cast<std::ptrdiff_t>(first), patches.rows.end());
    for (std::size_t k = first; k < patches.rows.size(); ++k) is_covered[patches.rows[k]] = 1;
    patches.rows.push_back(i);
    patches.start.push_back(patches.rows.size());
  }
  for (int i = 0; i < local.numRows(); ++i)
    if (!is_pressure[i] && !is_covered[i]) patches.lone_rows.push_back(i);
  return patches;
}

std::vector<char> scalar_rows(const CrsMatrix& K, const MixedNumbering& numbering) {
  std::vector<char> flags(K.getNodeNumRows());
  for (std::size_t i = 0; i < flags.size(); ++i)
    flags[i] = numbering.is_scalar(K.getRowMap()->getGlobalElement(static_cast<int>(i)));
  return flags;
}

}  // namespace tunica::multigrid
