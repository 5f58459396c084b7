#include <algorithm>

#include "tunica/base/formatted.hpp"
#include "tunica/compare/solver_table.hpp"

namespace tunica::compare {

namespace {

/// What stands in the line of a setting.
struct Line {
  std::string setting;
  std::vector<std::string> iterations;
  double setup_seconds = 0.0, solve_seconds = 0.0, difference = 0.0, refresh_seconds = 0.0,
         memory_megabytes = 0.0;
  std::vector<double> of_fields;  ///< largest residual of each
  double backward_error = 0.0;
  bool is_ever_converged = false;
  multigrid::Levels levels;
};

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

void note_residuals(const Residuals& residuals, Line& line) {
  line.backward_error = std::max(line.backward_error, residuals.backward_error);
  line.of_fields.resize(residuals.of_fields.size(), 0.0);
  for (std::size_t f = 0; f < residuals.of_fields.size(); ++f)
    line.of_fields[f] = std::max(line.of_fields[f], residuals.of_fields[f]);
}

std::vector<Line> lines_of(const std::vector<SolverRow>& rows) {
  std::vector<Line> lines;
  for (const SolverRow& row : rows) {
    Line& line = line_of(lines, row.setting);
    const std::string count = row.solve.iterations > 0 ? std::to_string(row.solve.iterations) : "-";
    line.iterations.push_back(row.solve.is_converged ? count : count + "!");
    line.setup_seconds += row.solve.setup_seconds;
    line.refresh_seconds += row.refresh_seconds;
    line.solve_seconds += row.solve.solve_seconds;
    line.levels = row.solve.levels;
    line.memory_megabytes = std::max(line.memory_megabytes, row.memory_megabytes);
    if (!row.solve.is_converged) continue;
    line.is_ever_converged = true;
    note_residuals(row.residuals, line);
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
                     " unknowns, iterations and total seconds\n  " +
                     (rows.front().newton_step > 0 ? "Newton step" : "           ") +
                     std::string(width - 11, ' ');
  for (const SolverRow& row : rows)
    if (row.setting == rows.front().setting)
      text += row.newton_step > 0 ? formatted("%7d", row.newton_step) : "  count";
  text += "   set-up s  refresh s   solve s    ratio     MB  difference";
  for (const std::string& field : rows.front().fields)
    text += padded(field, std::max<std::size_t>(10, field.size() + 2));
  return text + "  backward\n";
}

std::string text_of(const Line& line, std::size_t width, double measure) {
  std::string text = "  " + line.setting + std::string(width - line.setting.size(), ' ');
  for (const std::string& iterations : line.iterations) text += padded(iterations, 7);
  const double seconds = line.setup_seconds + line.solve_seconds;
  text += formatted("%11.3f%11.3f%10.3f%9.2f%7.0f", line.setup_seconds, line.refresh_seconds,
                    line.solve_seconds, seconds / measure, line.memory_megabytes);
  if (!line.is_ever_converged) return text + "           -\n";
  text += formatted("%12.1e", line.difference);
  for (const double residual : line.of_fields) text += formatted("%10.1e", residual);
  return text + formatted("%10.1e\n", line.backward_error);
}

/// `  levels of A, B: 25200, 3840, 640 unknowns, operator complexity 1.21` for each hierarchy.
std::string levels_text(const std::vector<Line>& lines) {
  std::vector<std::pair<std::string, std::string>> found;
  for (const Line& line : lines) {
    if (line.levels.unknowns.empty()) continue;
    std::string sizes;
    for (const long long n : line.levels.unknowns)
      sizes += (sizes.empty() ? "" : ", ") + std::to_string(n);
    sizes += " unknowns" + formatted(", operator complexity %.2f", line.levels.operator_complexity);
    if (line.levels.is_w_cycle) sizes += ", W cycles";
    const auto same = std::find_if(found.begin(), found.end(),
                                   [&](const auto& entry) { return entry.first == sizes; });
    if (same == found.end())
      found.emplace_back(sizes, line.setting);
    else
      same->second += "; " + line.setting;
  }
  std::string text;
  for (const auto& [sizes, settings] : found)
    text += "  levels of " + settings + ": " + sizes + "\n";
  return text;
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
  text += levels_text(lines);
  for (const SolverRow& row : rows)
    if (!row.solve.is_converged)
      text += (row.newton_step > 0 ? formatted("  ! Newton step %d, ", row.newton_step) : "  ! ") +
              row.setting + ": " + row.verdict +
              formatted(", true residual %.1e\n", row.solve.true_residual);
  for (const SolverRow& row : rows)
    if (row.is_at_rounding)
      text += "  " + row.setting + ": as near as double precision allows, " +
              formatted("backward error %.1e (relative residual %.1e)\n",
                        row.residuals.backward_error, row.solve.true_residual);
  return text;
}

}  // namespace tunica::compare
