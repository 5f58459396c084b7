#include "tunica/systems/check_blocks.hpp"

#include <algorithm>
#include <cmath>

#include "tunica/base/agreement.hpp"
#include "tunica/base/error.hpp"
#include "tunica/base/formatted.hpp"
#include "tunica/base/reduce.hpp"
#include "tunica/base/rows.hpp"
#include "tunica/systems/preparation.hpp"

namespace tunica::systems {

namespace {

/// Entries of a row that are not zero.
long long n_entries(const MatrixRows& block, std::size_t row) {
  const auto begin = block.values.begin();
  return std::count_if(begin + static_cast<std::ptrdiff_t>(block.start[row]),
                       begin + static_cast<std::ptrdiff_t>(block.start[row + 1]),
                       [](double value) { return value != 0.0; });
}

/// Where the diagonal of a row stands.
std::size_t diagonal(const MatrixRows& block, std::size_t row) {
  const long long number = block.first_row() + static_cast<long long>(row);
  std::size_t k = block.start[row];
  while (block.columns[k] != number) ++k;
  return k;
}

/// Unit rows in the place of those of a field without an entry in K.
std::string fill_rows(Blocks& blocks, int field, OfUnknowns& known_in) {
  MatrixRows& square = blocks(field, field);
  const MatrixRows& other = blocks(field, 1 - field);
  std::vector<std::size_t> filled;
  for (std::size_t i = 0; i < square.n_local_rows(); ++i) {
    if (n_entries(square, i) + n_entries(other, i) > 0) continue;
    filled.push_back(i);
    known_in[field][i] = undetermined;
    square.values[diagonal(square, i)] = field == 0 ? 1.0 : -1.0;
  }
  const std::string all = text_of_rows(blocks, field, filled);
  if (all.empty()) return "";
  return all + (all.find("rows") == 0
                    ? " have no entries: nothing determines these unknowns, which are set to zero"
                    : " has no entries: nothing determines this unknown, which is set to zero");
}

}  // namespace

std::string text_of_rows(const Blocks& blocks, int field, const std::vector<std::size_t>& rows) {
  std::vector<long long> mine;
  for (const std::size_t row : rows) mine.push_back(blocks.file_rows[field][row]);
  return text_of_rows(blocks.comm(), mine, blocks.files[field]);
}

std::string text_of_rows(const Comm& comm, const std::vector<long long>& rows,
                         const std::string& files) {
  std::vector<long long> all = gather_rows(comm, rows);
  if (all.empty()) return "";
  std::sort(all.begin(), all.end());
  constexpr std::size_t most = 6;
  std::vector<std::string> names;
  for (std::size_t k = 0; k < std::min(all.size(), most); ++k)
    names.push_back(std::to_string(all[k] + 1));
  if (all.size() > most) names.push_back(std::to_string(all.size() - most) + " more");
  return (all.size() > 1 ? "rows " : "row ") + listed(names) + " of " + files;
}

std::string fill_empty_rows(Blocks& blocks, OfUnknowns& known_in) {
  const std::string vectors = fill_rows(blocks, 0, known_in);
  const std::string scalars = fill_rows(blocks, 1, known_in);
  return vectors.empty() || scalars.empty() ? vectors + scalars : vectors + "; " + scalars;
}

// In a saddle-point problem the symmetric parts of A and C are both positive, so that K has −C.
// Rows that give the values of their unknowns may have any sign.
std::string doubt_sign_of_c(const Blocks& blocks) {
  const auto trace = [&](int field) {
    const MatrixRows &square = blocks(field, field), &other = blocks(field, 1 - field);
    double sum = 0.0;
    for (std::size_t i = 0; i < square.n_local_rows(); ++i)
      if (n_entries(square, i) + n_entries(other, i) > 1) sum += square.values[diagonal(square, i)];
    return global_sum(blocks.comm(), sum);
  };
  if (!(trace(0) > 0.0 && trace(1) > 0.0)) return "";
  return "the diagonal of (C factor) C is negative, that of A positive: if the file contains the "
         "block as it is in K, set \"C factor\" to -1";
}

}  // namespace tunica::systems
