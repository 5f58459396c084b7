#include "tunica/io/csv_table.hpp"

#include <array>
#include <cerrno>
#include <charconv>
#include <cstdlib>
#include <stdexcept>

#include "tunica/io/atomic_file.hpp"
#include "tunica/io/messages.hpp"

namespace tunica::io {

namespace {

std::string text(long long value) { return std::to_string(value); }

std::string text(double value) {
  std::array<char, 32> digits;
  const auto end = std::to_chars(digits.data(), digits.data() + digits.size(), value).ptr;
  return {digits.data(), end};
}

std::string text(const std::string& value) {
  if (value.find_first_of(",\"\r\n") == std::string::npos) return value;
  std::string quoted = "\"";
  for (const char c : value) quoted += c == '"' ? std::string("\"\"") : std::string(1, c);
  return quoted + "\"";
}

}  // namespace

CsvTable::CsvTable(const std::string& path, std::vector<std::string> columns, bool active,
                   int kept_step)
    : path_(path), columns_(std::move(columns)), active_(active) {
  if (!active_) return;
  std::string heading;
  for (const std::string& column : columns_) heading += (heading.empty() ? "" : ",") + text(column);
  if (kept_step > 0) keep(heading, kept_step);
  file_.open(path_, kept_step > 0 ? std::ios::app : std::ios::trunc);
  if (kept_step == 0) put(heading);
}

void CsvTable::keep(const std::string& heading, int kept_step) {
  std::ifstream earlier(path_);
  std::string line;
  std::getline(earlier, line);
  const bool is_another = earlier.is_open() && line != heading;
  AtomicFile kept(path_);  // line by line: the table of a long run is large
  kept.add(heading + '\n');
  // A row that a killed run has not finished lacks its line break.
  while (!is_another && std::getline(earlier, line) && !earlier.eof()) {
    const long step = std::strtol(line.c_str(), nullptr, 10);
    if (step > 0 && step <= kept_step) kept.add(line + '\n');
  }
  earlier.close();
  if (is_another) {
    const Result<std::string> old_path = set_aside(path_);
    if (old_path.is_failure()) throw std::runtime_error(old_path.reason());
    print_error_line("warning: " + path_ +
                     " has other columns than before and begins anew; its previous rows are in " +
                     old_path.value());
  }
  const Outcome written = kept.commit();
  if (written.is_failure()) throw std::runtime_error(written.reason());
}

void CsvTable::row(const std::vector<Cell>& cells) {
  if (cells.size() != columns_.size()) {
    throw std::logic_error(path_ + ": a row of " + std::to_string(cells.size()) +
                           " cells, expected " + std::to_string(columns_.size()));
  }
  if (!active_) return;
  std::string line;
  for (std::size_t i = 0; i < cells.size(); ++i) {
    if (i > 0) line += ',';
    line += std::visit([](const auto& value) { return text(value); }, cells[i]);
  }
  put(line);
}

void CsvTable::put(const std::string& line) {
  errno = 0;
  file_ << line << '\n' << std::flush;
  if (!file_) throw std::runtime_error("cannot write " + path_ + system_reason());
}

}  // namespace tunica::io
