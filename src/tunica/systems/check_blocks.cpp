#include "tunica/systems/check_blocks.hpp"

#include <algorithm>
#include <cmath>

#include "tunica/base/agreement.hpp"
#include "tunica/base/error.hpp"
#include "tunica/base/formatted.hpp"
#include "tunica/base/reduce.hpp"
#include "tunica/base/rows.hpp"

namespace tunica::systems {

namespace {

bool is_empty(const MatrixRows& block, std::size_t row) {
  const auto begin = block.values.begin();
  return std::all_of(begin + static_cast<std::ptrdiff_t>(block.start[row]),
                     begin + static_cast<std::ptrdiff_t>(block.start[row + 1]),
                     [](double value) { return value == 0.0; });
}

/// Where the diagonal of a row stands.
std::size_t diagonal(const MatrixRows& block, std::size_t row) {
  const long long number = block.first_row() + static_cast<long long>(row);
  std::size_t k = block.start[row];
  while (block.columns[k] != number) ++k;
  return k;
}

/// "rows 6 and 21", "row 3", "rows 1, 2, 3, 4, 5, 6 and 12 more"; numbers from 1.
std::string text_of(const std::vector<long long>& rows) {
  constexpr std::size_t most = 6;
  std::vector<std::string> names;
  for (std::size_t k = 0; k < std::min(rows.size(), most); ++k)
    names.push_back(std::to_string(rows[k] + 1));
  if (rows.size() > most) names.push_back(std::to_string(rows.size() - most) + " more");
  return (rows.size() > 1 ? "rows " : "row ") + listed(names);
}

/// Rows [square other] of K without an entry; a unit row where b is zero there.
std::string fill_rows(MatrixRows& square, const MatrixRows& other, double unit,
                      const std::vector<double>& b, const std::string& names) {
  std::vector<long long> filled, senseless;
  for (std::size_t i = 0; i < square.n_local_rows(); ++i) {
    if (!is_empty(square, i) || !is_empty(other, i)) continue;
    (b[i] == 0.0 ? filled : senseless).push_back(square.first_row() + static_cast<long long>(i));
    square.values[diagonal(square, i)] = unit;
  }
  const std::vector<long long> wrong = gather_rows(*square.comm, senseless);
  on_root(*square.comm, [&] {
    TUNICA_CHECK(wrong.empty(), "System: " + text_of(wrong) + " of " + names +
                                    " have no entries, but the right-hand side is not zero there: "
                                    "no solution fulfils these equations.");
  });
  const std::vector<long long> all = gather_rows(*square.comm, filled);
  return all.empty() ? ""
                     : text_of(all) + " of " + names + (all.size() > 1 ? " have" : " has") +
                           " no entries: nothing determines these unknowns, which are set to zero";
}

}  // namespace

std::vector<double> rows_of_block(const ColumnRows& b, long long begin, long long count,
                                  const Comm& comm) {
  const Portion mine = portion_of(b.n_rows, comm);
  const auto place = [&](long long row) {
    return b.values.begin() + (std::clamp(row, mine.first, mine.first + mine.count) - mine.first);
  };
  return spread(comm, std::vector<double>(place(begin), place(begin + count)),
                std::max(mine.first - begin, 0LL), count);
}

std::string fill_empty_rows(Blocks& blocks) {
  const Comm& comm = *blocks.A.comm;
  const long long n = blocks.A.n_rows, m = blocks.B2.n_rows;
  const std::string vectors =
      fill_rows(blocks.A, blocks.B1T, 1.0, rows_of_block(blocks.b, 0, n, comm), "A and B1T");
  const std::string scalars =
      fill_rows(blocks.mC, blocks.B2, -1.0, rows_of_block(blocks.b, n, m, comm), "B2 and C");
  return vectors.empty() || scalars.empty() ? vectors + scalars : vectors + "; " + scalars;
}

// In a saddle-point problem the symmetric parts of A and C are both positive, so that K has −C.
std::string doubt_sign_of_C(const Blocks& blocks) {
  const auto trace = [](const MatrixRows& block) {
    double sum = 0.0;
    for (std::size_t i = 0; i < block.n_local_rows(); ++i) sum += block.values[diagonal(block, i)];
    return global_sum(*block.comm, sum);
  };
  if (!(trace(blocks.A) > 0.0 && trace(blocks.mC) > 0.0)) return "";
  return "the diagonal of (C factor) C is negative, that of A positive: if the file contains the "
         "block as it is in K, set \"C factor\" to -1";
}

}  // namespace tunica::systems
