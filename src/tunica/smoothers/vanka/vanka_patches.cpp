#include "tunica/smoothers/vanka/vanka_patches.hpp"

#include <algorithm>
#include <stdexcept>
#include <unordered_map>

#include "tunica/base/sort_once.hpp"
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

/// Appends the first n rows of a place, or all, but the uncovered ones.
void append(VankaPatches& patches, const RowsOfPlaces& places, int place, int n = -1) {
  const std::size_t first = places.start[place];
  const std::size_t end = n < 0 ? places.start[place + 1] : first + n;
  for (std::size_t r = first; r < end; ++r)
    if (!std::binary_search(patches.uncovered_rows.begin(), patches.uncovered_rows.end(),
                            places.rows[r]))
      patches.rows.push_back(places.rows[r]);
}

}  // namespace

int VankaPatches::largest() const {
  int most = 0;
  for (int p = 0; p < n_patches(); ++p) most = std::max(most, size(p));
  return most;
}

// P_i = {i} ∪ {velocities j : B2_ij ≠ 0} for each pressure i, on the rows of the rank. Values
// count, not the graph: where Dirichlet conditions have dropped a column its velocity is
// eliminated.
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
    // In no patch it would never move: it is solved alone.
    if (!is_pressure[i] && !is_covered[i]) patches.uncovered_rows.push_back(i);
  return patches;
}

// P_i with all velocities of the vertices that it reaches: node blocks of A are then whole in each
// patch, and their inverses serve all.
VankaPatches make_nodal_patches(const CrsMatrix& K, const MixedRows& mixed) {
  const RowsOfPlaces places = rows_of_places(mixed);
  const VankaPatches reached = make_vanka_patches(K, mixed.is_pressure);
  VankaPatches patches = without_patches(reached);
  for (int p = 0; p < reached.n_patches(); ++p) {
    std::vector<int> near;
    for (std::size_t k = reached.start[p]; k + 1 < reached.start[p + 1]; ++k)
      near.push_back(mixed.place[reached.rows[k]]);
    sort_once(near);
    for (const int place : near) append(patches, places, place, places.n_velocities[place]);
    patches.rows.push_back(reached.rows[reached.start[p + 1] - 1]);
    patches.start.push_back(patches.rows.size());
  }
  return patches;
}

VankaPatches make_pair_patches(const CrsMatrix& K, const MixedRows& mixed) {
  const RowsOfPlaces places = rows_of_places(mixed);
  VankaPatches patches = without_patches(make_vanka_patches(K, mixed.is_pressure));
  const std::vector<int> row_of_column = rows_of_columns(K, patches.column_of_row);
  const auto local = K.getLocalMatrixHost();
  const auto add_patch = [&](int first, int last) {
    if (first != last) append(patches, places, first);
    append(patches, places, last);
    patches.start.push_back(patches.rows.size());
  };
  // Neighbours by pressure in the graph, and vertices without pressure that B2 reaches
  for (int here = 0; here < places.n_places(); ++here) {
    std::vector<int> with_pressure, without;
    for (std::size_t r = places.start[here] + places.n_velocities[here]; r < places.start[here + 1];
         ++r) {
      const auto row = local.rowConst(places.rows[r]);
      for (int k = 0; k < row.length; ++k) {
        const int j = row_of_column[row.colidx(k)];
        if (j < 0 || mixed.place[j] == here) continue;
        if (mixed.is_pressure[j])
          with_pressure.push_back(mixed.place[j]);
        else if (row.value(k) != 0.0 && !places.has_pressure(mixed.place[j]))
          without.push_back(mixed.place[j]);
      }
    }
    sort_once(with_pressure);
    sort_once(without);
    // A pair once, from its lower place; a vertex without pressure with each that reaches it; a
    // pressure without neighbours alone
    for (const int other : with_pressure)
      if (other > here) add_patch(here, other);
    for (const int other : without) add_patch(other, here);
    if (with_pressure.empty() && without.empty() && places.has_pressure(here))
      add_patch(here, here);
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
    // 2 is neither of both, so that entries seen for the first time count as new.
    if (reaches.size() < next + row.length) reaches.resize(next + row.length, 2);
    for (int k = 0; k < row.length; ++k, ++next) {
      const char now = row.value(k) != 0.0;
      is_new |= reaches[next] != now;
      reaches[next] = now;
    }
  }
  return is_new;
}

// A node with a host stands at the host's vertex, others at their own.
MixedRows mixed_rows(const CrsMatrix& K, const algebra::DofLayout& numbering,
                     const Teuchos::RCP<const Vector>& hosts) {
  MixedRows mixed;
  std::unordered_map<GlobalOrdinal, int> places;
  const auto host = hosts.is_null() ? Teuchos::ArrayRCP<const Scalar>() : hosts->getData();
  for (const GlobalOrdinal number : global_numbers(*K.getRowMap())) {
    GlobalOrdinal node = number / numbering.dofs();
    const int local = hosts.is_null() ? -1 : hosts->getMap()->getLocalElement(node);
    if (local >= 0 && host[local] >= 0.0) node = static_cast<GlobalOrdinal>(host[local]);
    mixed.is_pressure.push_back(numbering.is_scalar(number));
    mixed.place.push_back(places.emplace(node, static_cast<int>(places.size())).first->second);
  }
  return mixed;
}

RowsOfPlaces rows_of_places(const MixedRows& mixed) {
  const auto& place_of = mixed.place;
  if (place_of.size() != mixed.is_pressure.size() ||
      std::any_of(place_of.begin(), place_of.end(), [](int place) { return place < 0; }))
    throw std::invalid_argument("Vanka: patches of nodes need the place of each row.");
  RowsOfPlaces places;
  // Sorted by counting: rows of a place together, and its velocities before its pressures
  std::vector<int> count;
  for (std::size_t row = 0; row < mixed.place.size(); ++row) {
    const std::size_t place = mixed.place[row];
    if (place >= count.size()) {
      count.resize(place + 1, 0);
      places.n_velocities.resize(place + 1, 0);
    }
    ++count[place];
    if (!mixed.is_pressure[row]) ++places.n_velocities[place];
  }
  places.start.push_back(0);
  for (const int n : count) places.start.push_back(places.start.back() + n);
  places.rows.resize(mixed.place.size());
  std::vector<std::size_t> next(places.start.begin(), places.start.end() - 1);
  for (const bool is_pressure : {false, true})
    for (std::size_t row = 0; row < mixed.place.size(); ++row)
      if ((mixed.is_pressure[row] != 0) == is_pressure)
        places.rows[next[mixed.place[row]]++] = static_cast<int>(row);
  return places;
}

}  // namespace tunica::smoothers
