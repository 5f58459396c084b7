#pragma once
#include <fstream>
#include <string>
#include <variant>
#include <vector>

namespace tunica::io {

/// One entry of a table. int and bool convert to long long, string literals to string.
using Cell = std::variant<long long, double, std::string>;

/// A table written row by row, complete on disk after each row, so that a run can be watched
/// and a killed one leaves what it had.
///
/// Numbers are printed with as few digits as give the same number back (at most 17). Texts with
/// commas, quotes or line breaks are quoted as in RFC 4180.
/// One rank is active; on all others the object does nothing. Not collective: a full disk
/// throws on the active rank only.
class CsvTable {
public:
  /// Replaces the file and writes the heading. With kept_step > 0 the whole rows of the file whose
  /// first cell is at most kept_step stay; where its heading is another one, the file is
  /// set aside as "steps.old.csv" instead.
  CsvTable(const std::string& path, std::vector<std::string> columns, bool active,
           int kept_step = 0);

  /// Throws std::runtime_error that names the file if it cannot be written, and
  /// std::logic_error if the number of cells is not that of the columns.
  void row(const std::vector<Cell>& cells);

  const std::vector<std::string>& columns() const { return columns_; }

private:
  void keep(const std::string& heading, int kept_step);
  void put(const std::string& line);

  std::string path_;
  std::vector<std::string> columns_;
  bool active_;
  std::ofstream file_;
};

}  // namespace tunica::io
