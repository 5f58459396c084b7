#include <algorithm>
#include <cstdio>

#include "app/solver_table.hpp"

namespace tunica::app {

namespace {

/// What stands in the line of a setting.
struct Line {
  std::string setting;
  std::vector<std::string> iterations;
  double setup_seconds = 0.0, solve_seconds = 0.0, difference = 0.0;
  bool is_ever_converged = false;
};

template <class... Values>
std::string formatted(const char* format, Values... values) {
  std::string text(256, '\0');
  text.resize(static_cast<std::size_t>(
      std::max(0, std::snprintf(text.data(), text.size(), format, values...))));
  return text;
}

std::string padded(const std::string& text, std::size_t width) {
  return text.size() < width ? std::string(width - text.size(), ' ') + text : text;
}

Line& line_of(std::vector<Line>& lines, const std::string& setting) {
  const auto found = std::find_if(lines.begin(), lines.end(),
                                  [&](const Line& line) { return line.setting == setting; });
  if (found != lines.end()) return *found;
  lines.emplace_back().setting = setting;
  return lines.back();
}

std::vector<Line> lines_of(const std::vector<SolverRow>& rows) {
  std::vector<Line> lines;
  for (const SolverRow& row : rows) {
    Line& line = line_of(lines, row.setting);
    const std::string count = row.solve.iterations > 0 ? std::to_string(row.solve.iterations) : "-";
    line.iterations.push_back(row.solve.is_converged ? count : count + "!");
    line.setup_seconds += row.solve.setup_seconds;
    line.solve_seconds += row.solve.solve_seconds;
    if (!row.solve.is_converged) continue;
    line.is_ever_converged = true;
    line.difference = std::max(line.difference, row.difference);
  }
  return lines;
}

/// Settings have names of different lengths.
std::size_t width_of(const std::vector<Line>& lines) {
  std::size_t width = 11;
  for (const Line& line : lines) width = std::max(width, line.setting.size());
  return width;
}

std::string heading(const std::vector<SolverRow>& rows, std::size_t width) {
  std::string text = "\n" + rows.front().field + ", " + std::to_string(rows.front().unknowns) +
                     " unknowns, iterations and total seconds\n  Newton step" +
                     std::string(width - 11, ' ');
  for (const SolverRow& row : rows)
    if (row.setting == rows.front().setting) text += formatted("%7d", row.newton_step);
  return text + "   set-up s   solve s    ratio  difference\n";
}

std::string text_of(const Line& line, std::size_t width, double measure) {
  std::string text = "  " + line.setting + std::string(width - line.setting.size(), ' ');
  for (const std::string& iterations : line.iterations) text += padded(iterations, 7);
  const double seconds = line.setup_seconds + line.solve_seconds;
  text += formatted("%11.3f%10.3f%9.2f", line.setup_seconds, line.solve_seconds, seconds / measure);
  return text +
         (line.is_ever_converged ? formatted("%12.1e\n", line.difference) : "           -\n");
}

}  // namespace

std::string text_of(const std::vector<SolverRow>& all, const std::string& field) {
  std::vector<SolverRow> rows;
  std::copy_if(all.begin(), all.end(), std::back_inserter(rows),
               [&](const SolverRow& row) { return row.field == field; });
  if (rows.empty()) return "";
  const std::vector<Line> lines = lines_of(rows);
  const std::size_t width = width_of(lines);
  const double measure = lines.front().setup_seconds + lines.front().solve_seconds;
  std::string text = heading(rows, width);
  for (const Line& line : lines) text += text_of(line, width, measure);
  for (const SolverRow& row : rows)
    if (!row.solve.is_converged)
      text += formatted("  ! Newton step %d, ", row.newton_step) + row.setting + ": " +
              row.verdict + formatted(", true residual %.1e\n", row.solve.true_residual);
  return text;
}

}  // namespace tunica::app
