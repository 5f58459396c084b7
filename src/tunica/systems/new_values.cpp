#include "tunica/systems/new_values.hpp"

#include <algorithm>
#include <cmath>

#include "tunica/algebra/entry_offsets.hpp"
#include "tunica/base/agreement.hpp"
#include "tunica/base/exchange.hpp"
#include "tunica/base/reduce.hpp"
#include "tunica/base/trilinos.hpp"
#include "tunica/systems/null_space.hpp"
#include "tunica/systems/right_side.hpp"

namespace tunica::systems {

namespace {

struct PlaceInFile {
  long long row, column;
};

/// The ranks that have rows of the files. Collective.
std::vector<int> ranks_of_rows(const System& system, const std::vector<long long>& rows) {
  std::vector<int> ranks(rows.size(), -1), of_field(rows.size());
  for (int i = 0; i < system.K.n_blocks(); ++i) {
    system.file_rows[i]->getRemoteIndexList(Teuchos::arrayViewFromVector(rows),
                                            Teuchos::arrayViewFromVector(of_field));
    for (std::size_t k = 0; k < rows.size(); ++k) ranks[k] = std::max(ranks[k], of_field[k]);
  }
  return ranks;
}

/// The rows of the files that the columns of a block have, ascending, each with its local column.
std::vector<std::pair<long long, int>> file_columns(const System& system, int field,
                                                    const CrsMatrix& A) {
  Vector mine(A.getDomainMap()), all(A.getColMap());
  {
    const auto to = mine.getLocalViewHost(overwrite_all);
    const auto rows = global_numbers(*system.file_rows[field]);
    for (std::size_t k = 0; k < to.extent(0); ++k) to(k, 0) = static_cast<double>(rows[k]);
  }
  all.doImport(mine, Import(mine.getMap(), all.getMap()), insert);
  const auto from = all.getLocalViewHost(read_only);
  std::vector<std::pair<long long, int>> columns;
  for (std::size_t k = 0; k < from.extent(0); ++k)
    columns.emplace_back(static_cast<long long>(from(k, 0)), static_cast<int>(k));
  std::sort(columns.begin(), columns.end());
  return columns;
}

/// Where entries stand in the blocks that are given.
class Finder {
public:
  explicit Finder(const System& system) : system_(system), fields_(system.K.n_blocks()) {
    for (int i = 0; i < fields_; ++i)
      for (int j = 0; j < fields_; ++j)
        columns_.push_back(file_columns(system, j, *system.given(i, j)));
  }

  std::pair<int, std::size_t> place(const PlaceInFile& entry) const {
    for (int i = 0; i < fields_; ++i) {
      const LocalOrdinal row = system_.file_rows[i]->getLocalElement(entry.row);
      if (row == Teuchos::OrdinalTraits<LocalOrdinal>::invalid()) continue;
      for (int j = 0; j < fields_; ++j) {
        const auto& columns = columns_[i * fields_ + j];
        const auto found = std::lower_bound(columns.begin(), columns.end(),
                                            std::pair<long long, int>(entry.column, 0));
        if (found == columns.end() || found->first != entry.column) continue;
        const auto graph = system_.given(i, j)->getLocalMatrixHost().graph;
        const int* const first = graph.entries.data() + graph.row_map(row);
        const int* const last = graph.entries.data() + graph.row_map(row + 1);
        const int* const there = std::lower_bound(first, last, found->second);
        if (there != last && *there == found->second)
          return {i * fields_ + j, static_cast<std::size_t>(there - graph.entries.data())};
      }
    }
    throw std::logic_error("NewValues: an entry is not in the system");
  }

private:
  const System& system_;
  int fields_;
  std::vector<std::vector<std::pair<long long, int>>> columns_;  ///< of each block
};

/// How new values contradict what was found in old ones.
struct Contradictions {
  double dropped = 0.0, coupled = 0.0,
         lone = 0.0;  ///< entries, and rows of known and free unknowns
};

/// Entries that may be left out because they are rounding, now as then.
constexpr double rounding_still = 1e-11;

/// Adds those of the rows of a field. kept: flags of the values given, of each block of the row.
void find_contradictions(const System& system, int i, const std::vector<std::vector<char>>& kept,
                         Contradictions& found) {
  const int fields = system.K.n_blocks();
  const auto known_in = system.known_in[i].getLocalViewHost(read_only);
  std::vector<double> beside(known_in.extent(0), 0.0), left_out = beside, d = beside;
  for (int j = 0; j < fields; ++j) {
    const CrsMatrix& A = *system.given(i, j);
    const OfColumns of(system, j, A);
    const auto column_known = of.known_in.getLocalViewHost(read_only);
    const auto local = A.getLocalMatrixHost();
    for (int row = 0; row < local.numRows(); ++row)
      for (std::size_t k = local.graph.row_map(row); k < local.graph.row_map(row + 1); ++k) {
        const int column = local.graph.entries(k);
        const double size = std::abs(local.values(k));
        const bool is_diagonal = i == j && A.getColMap()->getGlobalElement(column) ==
                                               A.getRowMap()->getGlobalElement(row);
        if (is_diagonal) d[row] = size;
        if (is_diagonal) continue;
        // A value found in an earlier round may stand beside a known one.
        const double known_before = column_known(column, 0);
        if (known_before == 0.0 || known_in(row, 0) == 0.0 || known_before >= known_in(row, 0))
          beside[row] = std::max(beside[row], size);
        if (kept[j][k] == 0 && known_before == 0.0) left_out[row] = std::max(left_out[row], size);
      }
  }
  for (std::size_t row = 0; row < beside.size(); ++row) {
    if (known_in(row, 0) > 0.0) found.coupled += !(beside[row] <= rounding_still * d[row]);
    if (known_in(row, 0) < 0.0) found.coupled += beside[row] + d[row] > 0.0;
    if (known_in(row, 0) != 0.0) continue;
    found.lone += beside[row] == 0.0;
    found.dropped += left_out[row] > rounding_still * std::max(beside[row], d[row]);
  }
}

}  // namespace

NewValues::NewValues(const SparseRows& pattern, long long first_row, const System& system)
    : n_values_(pattern.columns.size()) {
  std::vector<long long> rows;
  for (std::size_t i = 0; i < pattern.n_local_rows(); ++i)
    rows.push_back(first_row + static_cast<long long>(i));
  const std::vector<int> rank_of_row = ranks_of_rows(system, rows);
  std::vector<PlaceInFile> entries;
  entries.reserve(n_values_);
  ranks_.reserve(n_values_);
  for (std::size_t i = 0; i < rows.size(); ++i)
    for (std::size_t k = pattern.start[i]; k < pattern.start[i + 1]; ++k) {
      entries.push_back({rows[i], pattern.columns[k]});
      ranks_.push_back(rank_of_row[i]);
    }
  const Finder finder(system);
  for (const PlaceInFile& entry : exchange_to(*system.K.comm(), entries, ranks_).items)
    places_.push_back(finder.place(entry));
  for (int i = 0; i < system.K.n_blocks(); ++i)
    for (int j = 0; j < system.K.n_blocks(); ++j)
      offsets_.push_back(algebra::entry_offsets(*system.K(i, j), *system.given(i, j)));
}

void NewValues::fill(const double* values, System& system) const {
  const int fields = system.K.n_blocks();
  std::vector<double*> to;
  for (int block = 0; block < fields * fields; ++block) {
    const auto local = system.given(block / fields, block % fields)->getLocalMatrixHost().values;
    std::fill(local.data(), local.data() + local.extent(0), 0.0);
    to.push_back(local.data());
  }
  const std::vector<double> mine(values, values + n_values_);
  const std::vector<double> arrived = exchange_to(*system.K.comm(), mine, ranks_).items;
  // Entries that were given twice add up.
  for (std::size_t k = 0; k < arrived.size(); ++k) {
    const auto [block, place] = places_[k];
    to[block][place] += system.signs[block / fields] * arrived[k];
  }
}

// K'_ij = R_i K_ij C_j between free unknowns; unit rows of others
void NewValues::prepare(System& system) const {
  const int fields = system.K.n_blocks();
  for (int i = 0; i < fields; ++i) {
    const auto known_in = system.known_in[i].getLocalViewHost(read_only);
    const auto row_scale = system.row_scale[i].getLocalViewHost(read_only);
    for (int j = 0; j < fields; ++j) {
      const CrsMatrix& A = *system.K(i, j);
      const std::vector<int>& offsets = offsets_[i * fields + j];
      const OfColumns of(system, j, A);
      const auto scale = of.scale.getLocalViewHost(read_only);
      const auto from = system.given(i, j)->getLocalMatrixHost().values;
      const auto local = A.getLocalMatrixHost();
      for (int row = 0; row < local.numRows(); ++row)
        for (std::size_t k = local.graph.row_map(row); k < local.graph.row_map(row + 1); ++k)
          local.values(k) = known_in(row, 0) == 0.0 ? row_scale(row, 0) * from(offsets[k]) *
                                                          scale(local.graph.entries(k), 0)
                            : i == 0 ? 1.0
                                     : -1.0;
    }
  }
}

std::string NewValues::take(const double* values, System& system) const {
  const Comm& comm = *system.K.comm();
  const int fields = system.K.n_blocks();
  if (!system.border.empty()) return "the matrix has a border";
  fill(values, system);
  Contradictions found;
  for (int i = 0; i < fields; ++i) {
    std::vector<std::vector<char>> kept;
    for (int j = 0; j < fields; ++j) {
      kept.emplace_back(n_local_entries(*system.given(i, j)), 0);
      for (const int place : offsets_[i * fields + j]) kept.back()[place] = 1;
    }
    find_contradictions(system, i, kept, found);
  }
  if (global_sum(comm, found.dropped) > 0.0) return "entries that were rounding couple unknowns";
  if (global_sum(comm, found.coupled) > 0.0) return "rows that gave values have couplings";
  if (global_sum(comm, found.lone) > 0.0) return "rows that had couplings give values";
  prepare(system);
  const std::vector<ConstantMode> constants = find_constants(system);
  const auto same = [](const ConstantMode& a, const ConstantMode& b) {
    return a.field == b.field && a.component == b.component && a.left.is_null() == b.left.is_null();
  };
  if (system.is_searched_for_constants &&
      !std::equal(constants.begin(), constants.end(), system.constants.begin(),
                  system.constants.end(), same))
    return "the matrix has other constants in its null space";
  hold_constants(system);
  return "";
}

}  // namespace tunica::systems
