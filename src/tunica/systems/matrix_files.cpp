#include "tunica/systems/matrix_files.hpp"

#include <algorithm>
#include <optional>

#include "tunica/base/agreement.hpp"
#include "tunica/systems/matrix_market_reader.hpp"

namespace tunica::systems {

namespace {

using Sizes = std::vector<long long>;

/// The first entry on either side of the diagonal of a symmetric file, which has one side alone.
struct Triangles {
  std::optional<Entry> below, above;

  void note(const Entry& entry, const MatrixMarketReader& reader) {
    std::optional<Entry>& first = entry.row > entry.column ? below : above;
    if (!first) first = entry;
    if (!below || !above) return;
    const auto place = [](const Entry& at) {
      return "row " + std::to_string(at.row + 1) + ", column " + std::to_string(at.column + 1);
    };
    reader.refuse("the first line says \"symmetric\", but there are entries below the diagonal (" +
                  place(*below) + ") and above it (" + place(*above) +
                  "): expected those of one triangle, or \"general\" in the first line");
  }
};

/// What the next lines of a file of coordinates say, and their mirror images where it is symmetric.
std::vector<Entry> next_entries(MatrixMarketReader& reader, const Sizes& sizes, long long count,
                                const std::string& promise, Triangles& triangles) {
  const auto index = [&reader](const char* what, long long most) {
    const long long i = reader.integer(what);
    if (i < 1 || i > most)
      reader.refuse(std::string(what) + " is " + std::to_string(i) + ", expected 1 to " +
                    std::to_string(most));
    return i - 1;
  };
  std::vector<Entry> entries;
  for (long long k = 0; k < count; ++k) {
    reader.next_line(promise);
    const long long row = index("the row", sizes[0]), column = index("the column", sizes[1]);
    const double value = reader.number("the value");
    reader.end_line();
    entries.push_back({row, column, value});
    if (!reader.is_symmetric() || row == column) continue;
    triangles.note(entries.back(), reader);
    entries.push_back({column, row, value});
  }
  return entries;
}

std::vector<double> next_numbers(MatrixMarketReader& reader, long long count,
                                 const std::string& promise) {
  std::vector<double> numbers;
  for (long long i = 0; i < count; ++i) {
    reader.next_line(promise);
    numbers.push_back(reader.number("a number"));
    reader.end_line();
  }
  return numbers;
}

/// Hands on the lines of a file. read(count): what so many of them say, on rank 0.
/// take(items, first): all ranks take that, of which rank 0 has all and the others nothing.
template <class Read, class Take>
void read_lines(const Comm& comm, long long lines, std::size_t at_once, const Read& read,
                const Take& take) {
  const auto most = static_cast<long long>(at_once);
  for (long long first = 0; first < lines; first += most) {
    decltype(read(0LL)) items;
    on_root(comm, [&] { items = read(std::min(most, lines - first)); });
    take(items, first);
  }
}

}  // namespace

MatrixRows read_matrix(const std::string& path, const CommPtr& comm, std::size_t lines_at_once) {
  std::optional<MatrixMarketReader> reader;  // on rank 0
  Sizes sizes(3);
  on_root(*comm, [&] {
    reader.emplace(path, "coordinate");
    sizes = reader->sizes(3);
    if (reader->is_symmetric() && sizes[0] != sizes[1])
      reader->refuse("a symmetric matrix has as many rows as columns");
  });
  Teuchos::broadcast(*comm, 0, 3, sizes.data());
  const std::string promise = std::to_string(sizes[2]) + " entries, as the line of sizes says";
  RowCollector collector(sizes[0], sizes[1], comm);
  Triangles triangles;
  read_lines(
      *comm, sizes[2], lines_at_once,
      [&](long long count) { return next_entries(*reader, sizes, count, promise, triangles); },
      [&](const std::vector<Entry>& entries, long long) { collector.add(entries); });
  on_root(*comm, [&] { reader->end_file("expected " + promise); });
  return collector.take();
}

std::vector<ColumnRows> read_columns(const std::string& path, const CommPtr& comm, int count,
                                     std::size_t lines_at_once) {
  std::optional<MatrixMarketReader> reader;  // on rank 0
  Sizes sizes(2);
  on_root(*comm, [&] {
    reader.emplace(path, "array");
    sizes = reader->sizes(2);
    if (sizes[1] != count)
      reader->refuse("there are " + std::to_string(sizes[1]) + " columns, expected " +
                     (count == 1 ? "one" : std::to_string(count)));
  });
  Teuchos::broadcast(*comm, 0, 2, sizes.data());
  const std::string promise =
      std::to_string(sizes[0] * sizes[1]) + " numbers, as the line of sizes says";
  std::vector<ColumnRows> columns(sizes[1], ColumnRows{sizes[0], {}});
  for (ColumnRows& column : columns)
    read_lines(
        *comm, column.n_rows, lines_at_once,
        [&](long long lines) { return next_numbers(*reader, lines, promise); },
        [&](const std::vector<double>& numbers, long long first) {
          const std::vector<double> mine = spread(*comm, numbers, first, column.n_rows);
          column.values.insert(column.values.end(), mine.begin(), mine.end());
        });
  on_root(*comm, [&] { reader->end_file("expected " + promise); });
  return columns;
}

ColumnRows read_column(const std::string& path, const CommPtr& comm, std::size_t lines_at_once) {
  return read_columns(path, comm, 1, lines_at_once).front();
}

}  // namespace tunica::systems
