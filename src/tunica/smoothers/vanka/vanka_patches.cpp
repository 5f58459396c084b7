#include "tunica/smoothers/vanka/vanka_patches.hpp"

#include <algorithm>
#include <stdexcept>

#include "tunica/base/trilinos.hpp"

namespace tunica::smoothers {

namespace {

std::vector<int> rows_of_columns(const CrsMatrix& K, const std::vector<int>& column_of_row) {
  std::vector<int> row_of_column(n_local(*K.getColMap()), -1);
  for (std::size_t i = 0; i < column_of_row.size(); ++i)
    if (column_of_row[i] >= 0) row_of_column[column_of_row[i]] = static_cast<int>(i);
  return row_of_column;
}

/// What patches of another kind take over: without patches.
VankaPatches without_patches(const VankaPatches& from) {
  VankaPatches patches;
  patches.uncovered_rows = from.uncovered_rows;
  patches.column_of_row = from.column_of_row;
  patches.start.push_back(0);
  return patches;
}

/// Appends the rows first .. end-1 but the lone ones.
void append(VankaPatches& patches, int first, int end) {
  for (int row = first; row < end; ++row)
    if (!std::binary_search(patches.uncovered_rows.begin(), patches.uncovered_rows.end(), row))
      patches.rows.push_back(row);
}

}  // namespace

int VankaPatches::largest() const {
  int most = 0;
  for (int p = 0; p < n_patches(); ++p) most = std::max(most, size(p));
  return most;
}

VankaPatches make_vanka_patches(const CrsMatrix& K, const std::vector<char>& is_pressure) {
  const auto local = K.getLocalMatrixHost();
  VankaPatches patches;
  for (int i = 0; i < local.numRows(); ++i)
    patches.column_of_row.push_back(
        K.getColMap()->getLocalElement(K.getRowMap()->getGlobalElement(i)));
  const std::vector<int> row_of_column = rows_of_columns(K, patches.column_of_row);
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
    if (!is_pressure[i] && !is_covered[i]) patches.uncovered_rows.push_back(i);
  return patches;
}

VankaPatches make_nodal_patches(const CrsMatrix& K, const std::vector<char>& is_pressure) {
  const int velocities = velocities_per_node(is_pressure), unknowns = velocities + 1;
  const VankaPatches reached = make_vanka_patches(K, is_pressure);
  VankaPatches patches = without_patches(reached);
  for (int p = 0; p < reached.n_patches(); ++p) {
    int last_node = -1;
    for (std::size_t k = reached.start[p]; k + 1 < reached.start[p + 1]; ++k) {
      const int node = reached.rows[k] / unknowns;
      if (node != last_node) append(patches, unknowns * node, unknowns * node + velocities);
      last_node = node;
    }
    patches.rows.push_back(reached.rows[reached.start[p + 1] - 1]);
    patches.start.push_back(patches.rows.size());
  }
  return patches;
}

VankaPatches make_pair_patches(const CrsMatrix& K, const std::vector<char>& is_pressure) {
  const int unknowns = velocities_per_node(is_pressure) + 1;
  VankaPatches patches = without_patches(make_vanka_patches(K, is_pressure));
  const std::vector<int> row_of_column = rows_of_columns(K, patches.column_of_row);
  const auto local = K.getLocalMatrixHost();
  for (int i = unknowns - 1; i < local.numRows(); i += unknowns) {
    std::vector<int> others;
    bool is_alone = true;
    const auto row = local.rowConst(i);
    for (int k = 0; k < row.length; ++k) {
      const int j = row_of_column[row.colidx(k)];
      if (j >= 0 && is_pressure[j] && j > i) others.push_back(j);
      is_alone &= j < 0 || !is_pressure[j] || j == i;
    }
    if (is_alone) others.push_back(i);
    std::sort(others.begin(), others.end());
    for (const int j : others) {
      if (j != i) append(patches, i + 1 - unknowns, i + 1);
      append(patches, j + 1 - unknowns, j + 1);
      patches.start.push_back(patches.rows.size());
    }
  }
  return patches;
}

bool update_b2_pattern(const CrsMatrix& K, const std::vector<char>& is_pressure,
                       std::vector<char>& reaches) {
  const auto local = K.getLocalMatrixHost();
  bool is_new = false;
  std::size_t next = 0;
  for (int i = 0; i < local.numRows(); ++i) {
    if (!is_pressure[i]) continue;
    const auto row = local.rowConst(i);
    if (reaches.size() < next + row.length) reaches.resize(next + row.length, 2);
    for (int k = 0; k < row.length; ++k, ++next) {
      const char now = row.value(k) != 0.0;
      is_new |= reaches[next] != now;
      reaches[next] = now;
    }
  }
  return is_new;
}

int velocities_per_node(const std::vector<char>& is_pressure) {
  const auto first = std::find(is_pressure.begin(), is_pressure.end(), 1);
  const auto velocities = static_cast<std::size_t>(first - is_pressure.begin());
  bool is_nodal = is_pressure.size() % (velocities + 1) == 0;
  for (std::size_t i = 0; is_nodal && i < is_pressure.size(); ++i)
    is_nodal = (i % (velocities + 1) == velocities) == (is_pressure[i] != 0);
  if (!is_nodal && !is_pressure.empty())
    throw std::invalid_argument(
        "Vanka: patches of nodes need rows of as many velocities and one pressure for each node; "
        "where a node has several pressures, \"patch\" must be \"full\".");
  return static_cast<int>(velocities);
}

std::vector<char> scalar_rows(const CrsMatrix& K, const algebra::DofLayout& numbering) {
  std::vector<char> flags(n_local_rows(K));
  for (std::size_t i = 0; i < flags.size(); ++i)
    flags[i] = numbering.is_scalar(K.getRowMap()->getGlobalElement(static_cast<int>(i)));
  return flags;
}

}  // namespace tunica::smoothers
