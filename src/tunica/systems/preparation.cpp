#include "tunica/systems/preparation.hpp"

#include <algorithm>
#include <cmath>

#include "tunica/base/agreement.hpp"
#include "tunica/base/error.hpp"
#include "tunica/base/formatted.hpp"
#include "tunica/base/reduce.hpp"
#include "tunica/base/rows.hpp"
#include "tunica/systems/check_blocks.hpp"

namespace tunica::systems {

namespace {

constexpr int fields[] = {0, 1};

double larger(double a, double b) { return std::max(a, std::abs(b)); }

std::vector<double> row_maxima(const MatrixRows& A) {
  std::vector<double> largest(A.n_local_rows(), 0.0);
  for (std::size_t i = 0; i < largest.size(); ++i)
    for (std::size_t k = A.start[i]; k < A.start[i + 1]; ++k)
      largest[i] = larger(largest[i], A.values[k]);
  return largest;
}

std::vector<double> column_maxima(const MatrixRows& A) {
  return over_columns(
      A, [&](std::size_t, std::size_t k) { return A.values[k]; }, larger);
}

/// Keeps the entries that keep(row, k, column) lets stay. Not collective.
template <class Keep>
void keep_entries(MatrixRows& A, const Keep& keep) {
  std::size_t end = 0, first = 0;
  for (std::size_t i = 0; i < A.n_local_rows(); ++i) {
    for (std::size_t k = first; k < A.start[i + 1]; ++k) {
      if (!keep(i, k)) continue;
      A.columns[end] = A.columns[k];
      A.values[end++] = A.values[k];
    }
    first = A.start[i + 1];
    A.start[i + 1] = end;
  }
  A.columns.resize(end);
  A.values.resize(end);
}

bool is_diagonal(const Blocks& blocks, int i, int j, std::size_t row, std::size_t k) {
  const MatrixRows& A = blocks(i, j);
  return i == j && A.columns[k] == A.first_row() + static_cast<long long>(row);
}

/// The binary exponent that half of the numbers are not above; zeros do not count. 0 for none.
int typical_exponent(const Comm& comm, const std::vector<double>& numbers) {
  constexpr int most = 1100;
  std::vector<double> mine(2 * most, 0.0);
  for (const double number : numbers)
    if (number != 0.0 && std::isfinite(number)) ++mine[most + std::ilogb(number)];
  const std::vector<double> all = global_sum(comm, mine);
  double total = 0.0, counted = 0.0;
  for (const double count : all) total += count;
  for (int e = 0; e < 2 * most && total > 0.0; ++e)
    if ((counted += all[e]) >= 0.5 * total) return e - most;
  return 0;
}

int half_of(int exponent) { return static_cast<int>(std::floor(0.5 * exponent)); }

/// K ← R K C for exponents of two of each row and column.
void scale(Blocks& blocks, const OfUnknowns& rows, const OfUnknowns& columns,
           Preparation& preparation) {
  for (const int j : fields)
    for (const int i : fields) {
      MatrixRows& A = blocks(i, j);
      const Fetched<double> of_column(*A.comm, columns_of(A), columns[j], A.n_columns);
      for (std::size_t row = 0; row < A.n_local_rows(); ++row)
        for (std::size_t k = A.start[row]; k < A.start[row + 1]; ++k)
          A.values[k] =
              std::ldexp(A.values[k], static_cast<int>(rows[i][row] + of_column(A.columns[k])));
    }
  for (const int i : fields)
    for (std::size_t row = 0; row < blocks.n_local(i); ++row) {
      const int r = static_cast<int>(rows[i][row]), c = static_cast<int>(columns[i][row]);
      preparation.row_scale[i][row] = std::ldexp(preparation.row_scale[i][row], r);
      preparation.scale[i][row] = std::ldexp(preparation.scale[i][row], c);
    }
}

/// Of the diagonals of rows with something beside them: prescribed values may have any.
std::vector<double> coupled_diagonals(const Blocks& blocks, int i) {
  const MatrixRows& A = blocks(i, i);
  std::vector<double> d = diagonal(A);
  for (std::size_t row = 0; row < d.size(); ++row)
    if (A.start[row + 1] - A.start[row] < 2) d[row] = 0.0;
  return d;
}

}  // namespace

Preparation::Preparation(const Blocks& blocks) {
  for (const int i : fields) {
    known_in[i].assign(blocks.n_local(i), 0.0);
    scale[i].assign(blocks.n_local(i), 1.0);
    row_scale[i] = scale[i];
  }
}

void drop_negligible(Blocks& blocks, double part, Preparation& preparation) {
  long long dropped = 0, all = 0;
  for (const int i : fields)
    for (const int j : fields) {
      MatrixRows& A = blocks(i, j);
      const std::vector<double> of_rows = row_maxima(A);
      const Fetched<double> of_column(*A.comm, columns_of(A), column_maxima(A), A.n_columns);
      const auto before = static_cast<long long>(A.values.size());
      long long zeros = 0;
      keep_entries(A, [&](std::size_t row, std::size_t k) {
        if (is_diagonal(blocks, i, j, row, k)) return true;
        if (A.values[k] == 0.0) ++zeros;
        return std::abs(A.values[k]) > part * std::min(of_rows[row], of_column(A.columns[k]));
      });
      dropped += before - zeros - static_cast<long long>(A.values.size());
      all += before;
    }
  dropped = global_sum(blocks.comm(), dropped);
  all = global_sum(blocks.comm(), all);
  if (dropped > 0)
    preparation.notes.push_back(
        formatted("%lld of %lld entries are below %.0e of the largest ones of their row and of "
                  "their column: they are left out",
                  dropped, all, part));
}

// r_u c_u a = 1,  r_u c_p b₁ = 1,  r_p c_u b₂ = 1,  r_u = c_u, up to powers of two; a, b₁, b₂
// typical numbers of diag(A), columns of B1T and rows of B2. With B1T = B2ᵀ also r_p = c_p.
void scale_fields(Blocks& blocks, Preparation& preparation) {
  const Comm& comm = blocks.comm();
  const int of_u = -half_of(typical_exponent(comm, coupled_diagonals(blocks, 0)));
  const int b1 = typical_exponent(comm, column_maxima(blocks.B1T));
  const int b2 = typical_exponent(comm, row_maxima(blocks.B2));
  OfUnknowns rows, columns;
  rows[0].assign(blocks.n_local(0), of_u);
  columns[0] = rows[0];
  rows[1].assign(blocks.n_local(1), -b2 - of_u);
  columns[1].assign(blocks.n_local(1), -b1 - of_u);
  scale(blocks, rows, columns, preparation);
}

namespace {

constexpr double penalty = 1e12, beside_penalty = 1e-12;

/// Marks what is known by its row and not known yet. The number of all ranks.
long long find_known(const Blocks& blocks, Preparation& preparation,
                     std::array<std::vector<std::size_t>, 2>& found) {
  long long count = 0;
  for (const int i : fields) {
    const std::vector<double> d = diagonal(blocks(i, i));
    const double typical = std::ldexp(1.0, typical_exponent(blocks.comm(), d));
    for (std::size_t row = 0; row < d.size(); ++row) {
      if (preparation.known_in[i][row] != 0.0 || d[row] == 0.0) continue;
      double beside = 0.0;
      for (const int j : fields)
        for (std::size_t k = blocks(i, j).start[row]; k < blocks(i, j).start[row + 1]; ++k)
          if (!is_diagonal(blocks, i, j, row, k)) beside += std::abs(blocks(i, j).values[k]);
      const bool is_penalty = std::abs(d[row]) > penalty * std::max(typical, 1.0);
      if (beside > (is_penalty ? beside_penalty * std::abs(d[row]) : 0.0)) continue;
      preparation.known_in[i][row] = preparation.rounds + 1;
      found[i].push_back(row);
      ++count;
    }
  }
  return global_sum(blocks.comm(), count);
}

/// Columns and rows of what is known keep the diagonal.
void take_out(Blocks& blocks, const OfUnknowns& known_in) {
  for (const int i : fields)
    for (const int j : fields) {
      MatrixRows& A = blocks(i, j);
      const Fetched<double> of_column(*A.comm, columns_of(A), known_in[j], A.n_columns);
      keep_entries(A, [&](std::size_t row, std::size_t k) {
        return is_diagonal(blocks, i, j, row, k) ||
               (known_in[i][row] == 0.0 && of_column(A.columns[k]) == 0.0);
      });
    }
}

/// Known unknowns are zero in y, with a diagonal like that of others.
void make_unit_rows(Blocks& blocks, const std::array<std::vector<std::size_t>, 2>& found) {
  for (const int i : fields) {
    MatrixRows& A = blocks(i, i);
    for (const std::size_t row : found[i])
      for (std::size_t k = A.start[row]; k < A.start[row + 1]; ++k)
        if (is_diagonal(blocks, i, i, row, k)) A.values[k] = i == 0 ? 1.0 : -1.0;
  }
}

}  // namespace

void take_out_known(Blocks& blocks, Preparation& preparation) {
  std::array<std::vector<std::size_t>, 2> all;
  // Once for rows that were empty; what goes may leave rows that hold only their diagonal.
  for (bool is_over = false; !is_over;) {
    std::array<std::vector<std::size_t>, 2> found;
    is_over = find_known(blocks, preparation, found) == 0;
    if (!is_over) ++preparation.rounds;
    for (const int i : fields) all[i].insert(all[i].end(), found[i].begin(), found[i].end());
    take_out(blocks, preparation.known_in);
    make_unit_rows(blocks, found);
  }
  for (const int i : fields) {
    std::sort(all[i].begin(), all[i].end());
    const std::string rows = text_of_rows(blocks, i, all[i]);
    if (!rows.empty())
      preparation.notes.push_back(rows +
                                  " give the values of their unknowns, which are taken "
                                  "out of the system");
  }
  const std::string empty = fill_empty_rows(blocks, preparation.known_in);
  if (!empty.empty()) preparation.remarks.push_back(empty);
}

namespace {

constexpr double dense = 0.2;
constexpr std::size_t least_dense = 200;  ///< entries; small systems have no sparse rows
constexpr long long most_bordering = 8;   ///< each costs a solve

/// Free scalars with dense rows.
std::vector<std::size_t> dense_rows(const Blocks& blocks, const Preparation& preparation) {
  std::vector<std::size_t> found;
  for (std::size_t row = 0; row < blocks.n_local(1); ++row) {
    if (preparation.known_in[1][row] != 0.0) continue;
    for (const int j : fields) {
      const std::size_t entries = blocks(1, j).start[row + 1] - blocks(1, j).start[row];
      if (entries < least_dense ||
          static_cast<double>(entries) < dense * static_cast<double>(blocks.n_rows(j)))
        continue;
      found.push_back(row);
      break;
    }
  }
  const auto mine = static_cast<long long>(found.size());
  return global_sum(blocks.comm(), mine) <= most_bordering ? found : std::vector<std::size_t>();
}

/// Local rows of the free scalars that stand in these rows of the file, all of which have to be.
std::vector<std::size_t> rows_of(const Blocks& blocks, const std::vector<long long>& excluded,
                                 const Preparation& preparation) {
  std::vector<std::size_t> found;
  for (std::size_t row = 0; row < blocks.n_local(1); ++row)
    if (preparation.known_in[1][row] == 0.0 &&
        std::binary_search(excluded.begin(), excluded.end(), blocks.file_rows[1][row]))
      found.push_back(row);
  std::vector<long long> numbers;
  for (const std::size_t row : found) numbers.push_back(blocks.file_rows[1][row]);
  const std::vector<long long> all = gather_rows(blocks.comm(), numbers);
  on_root(blocks.comm(), [&] {
    for (const long long number : excluded)
      TUNICA_CHECK(std::find(all.begin(), all.end(), number) != all.end(),
                   "System: \"exclude\" names row " + std::to_string(number + 1) + " of " +
                       blocks.files[1] + ", which is not that of a free scalar.");
  });
  return found;
}

}  // namespace

void take_out_border(Blocks& blocks, const std::vector<long long>& excluded,
                     Preparation& preparation) {
  std::array<std::vector<std::size_t>, 2> found;
  found[1] = dense_rows(blocks, preparation);
  const std::vector<std::size_t> named = rows_of(blocks, excluded, preparation);
  found[1].insert(found[1].end(), named.begin(), named.end());
  std::sort(found[1].begin(), found[1].end());
  found[1].erase(std::unique(found[1].begin(), found[1].end()), found[1].end());
  const std::string rows = text_of_rows(blocks, 1, found[1]);
  if (global_sum(blocks.comm(), static_cast<long long>(found[1].size())) == 0) return;
  for (const std::size_t row : found[1]) preparation.known_in[1][row] = bordering;
  take_out(blocks, preparation.known_in);
  make_unit_rows(blocks, found);
  if (rows.empty()) return;  // but on rank 0
  const std::string verb = rows.find("rows") == 0 ? " are" : " is";
  preparation.notes.push_back(rows + verb +
                              " the border of the system, whose scalars are eliminated by a "
                              "solve of each");
}

namespace {

/// Largest entries beside the diagonal, of rows or columns of K.
std::vector<double> beside_diagonal(const Blocks& blocks, int field, bool of_rows) {
  std::vector<double> largest(blocks.n_local(field), 0.0);
  for (const int other : fields) {
    const int i = of_rows ? field : other, j = of_rows ? other : field;
    MatrixRows A = blocks(i, j);
    keep_entries(A, [&](std::size_t row, std::size_t k) {
      return i != j || A.columns[k] != A.first_row() + static_cast<long long>(row);
    });
    const std::vector<double> more = of_rows ? row_maxima(A) : column_maxima(A);
    for (std::size_t k = 0; k < largest.size(); ++k) largest[k] = larger(largest[k], more[k]);
  }
  return largest;
}

}  // namespace

void scale_outlying_rows(Blocks& blocks, Preparation& preparation) {
  constexpr int different = 13, penalty_exponent = 20;  // 8e3 and 1e6
  OfUnknowns rows, columns;
  for (const int i : fields) {
    rows[i].assign(blocks.n_local(i), 0.0);
    columns[i] = rows[i];
    const std::vector<double> d = diagonal(blocks(i, i)), of_row = beside_diagonal(blocks, i, true),
                              of_column = beside_diagonal(blocks, i, false);
    std::vector<std::size_t> found;
    for (std::size_t k = 0; k < d.size(); ++k) {
      if (of_row[k] == 0.0 || of_column[k] == 0.0) continue;
      const int apart = std::ilogb(of_row[k]) - std::ilogb(of_column[k]);
      const double most = std::max(of_row[k], of_column[k]);
      if (std::abs(apart) >= different)
        rows[i][k] = -apart;
      else if (std::abs(d[k]) > std::ldexp(most, penalty_exponent))
        rows[i][k] = columns[i][k] = -half_of(std::ilogb(d[k]));
      else
        continue;
      found.push_back(k);
    }
    const std::string text = text_of_rows(blocks, i, found);
    if (!text.empty())
      preparation.notes.push_back(text +
                                  " are much larger or smaller than the others: they are "
                                  "divided by powers of two");
  }
  scale(blocks, rows, columns, preparation);
}

}  // namespace tunica::systems
