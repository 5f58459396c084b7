#include "tunica/systems/matrix_files.hpp"

#include <algorithm>
#include <utility>

#include "tunica/systems/matrix_market_reader.hpp"

namespace tunica::systems {

namespace {

struct Entry {
  long long row, column;
  double value;
};

/// The entries that a file of coordinates lists, and their mirror images where it is symmetric.
std::vector<Entry> read_entries(MatrixMarketReader& reader, const std::vector<long long>& sizes) {
  const std::string promise = std::to_string(sizes[2]) + " entries, as the line of sizes says";
  const auto index = [&reader](const char* what, long long most) {
    const long long i = reader.integer(what);
    if (i < 1 || i > most)
      reader.refuse(std::string(what) + " is " + std::to_string(i) + ", expected 1 to " +
                    std::to_string(most));
    return i - 1;
  };
  std::vector<Entry> entries;
  for (long long k = 0; k < sizes[2]; ++k) {
    reader.next_line(promise);
    const long long row = index("the row", sizes[0]), column = index("the column", sizes[1]);
    const double value = reader.number("the value");
    reader.end_line();
    entries.push_back({row, column, value});
    if (reader.is_symmetric() && row != column) entries.push_back({column, row, value});
  }
  reader.end_file("expected " + promise);
  return entries;
}

}  // namespace

FileMatrix read_matrix(const std::string& path) {
  MatrixMarketReader reader(path, "coordinate");
  const std::vector<long long> sizes = reader.sizes(3);
  if (reader.is_symmetric() && sizes[0] != sizes[1])
    reader.refuse("a symmetric matrix has as many rows as columns");
  std::vector<Entry> entries = read_entries(reader, sizes);
  std::stable_sort(entries.begin(), entries.end(), [](const Entry& a, const Entry& b) {
    return std::pair(a.row, a.column) < std::pair(b.row, b.column);
  });
  FileMatrix A = empty_matrix(sizes[0], sizes[1]);
  for (std::size_t k = 0; k < entries.size(); ++k) {
    const Entry& entry = entries[k];
    const bool is_again =
        k > 0 && entries[k - 1].row == entry.row && entries[k - 1].column == entry.column;
    if (is_again) {  // what is listed twice is a sum, as in element matrices
      A.values.back() += entry.value;
      continue;
    }
    A.columns.push_back(entry.column);
    A.values.push_back(entry.value);
    ++A.start[entry.row + 1];
  }
  for (std::size_t i = 0; i + 1 < A.start.size(); ++i) A.start[i + 1] += A.start[i];
  return A;
}

std::vector<double> read_column(const std::string& path) {
  MatrixMarketReader reader(path, "array");
  const std::vector<long long> sizes = reader.sizes(2);
  if (sizes[1] != 1)
    reader.refuse("there are " + std::to_string(sizes[1]) + " columns, expected one");
  const std::string promise = std::to_string(sizes[0]) + " numbers, as the line of sizes says";
  std::vector<double> column;
  for (long long i = 0; i < sizes[0]; ++i) {
    reader.next_line(promise);
    column.push_back(reader.number("a number"));
    reader.end_line();
  }
  reader.end_file("expected " + promise);
  return column;
}

FileMatrix empty_matrix(long long n_rows, long long n_columns) {
  FileMatrix A;
  A.n_rows = n_rows;
  A.n_columns = n_columns;
  A.start.assign(static_cast<std::size_t>(n_rows) + 1, 0);
  return A;
}

FileMatrix transposed(const FileMatrix& A) {
  FileMatrix T = empty_matrix(A.n_columns, A.n_rows);
  for (const long long column : A.columns) ++T.start[column + 1];
  for (std::size_t i = 0; i + 1 < T.start.size(); ++i) T.start[i + 1] += T.start[i];
  std::vector<std::size_t> next(T.start.begin(), T.start.end() - 1);
  T.columns.resize(A.columns.size());
  T.values.resize(A.values.size());
  for (long long i = 0; i < A.n_rows; ++i)
    for (std::size_t k = A.start[i]; k < A.start[i + 1]; ++k) {
      const std::size_t place = next[A.columns[k]]++;
      T.columns[place] = i;
      T.values[place] = A.values[k];
    }
  return T;
}

}  // namespace tunica::systems
