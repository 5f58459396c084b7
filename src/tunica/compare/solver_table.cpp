#include "tunica/compare/solver_table.hpp"

#include <nlohmann/json.hpp>
#include <sstream>
#include <stdexcept>

#include "tunica/base/formatted.hpp"
#include "tunica/base/timer.hpp"
#include "tunica/coupling/coupling_settings.hpp"
#include "tunica/coupling/monolithic.hpp"
#include "tunica/io/atomic_file.hpp"
#include "tunica/io/messages.hpp"
#include "tunica/problems/fluid_problem.hpp"
#include "tunica/problems/solid_problem.hpp"

namespace tunica::compare {

namespace {

using Json = nlohmann::ordered_json;

std::vector<std::string> columns() {
  return {"field",
          "newton_step",
          "setting",
          "method",
          "preconditioner",
          "unknowns",
          "iterations",
          "convergence_factor",
          "true_residual",
          "recurrence_residual",
          "setup_seconds",
          "solve_seconds",
          "difference",
          "verdict",
          "levels",
          "operator_complexity",
          "operator_applications",
          "refresh_seconds",
          "memory_megabytes",
          "field_residuals",
          "backward_error",
          "setup_processor_seconds",
          "solve_processor_seconds"};
}

/// `vector 2.1e-09 scalar 4.0e-10`
std::string field_residuals(const SolverRow& row) {
  std::string text;
  for (std::size_t f = 0; f < row.residuals.of_fields.size(); ++f)
    text += (f == 0 ? "" : " ") + row.fields[f] + formatted(" %.1e", row.residuals.of_fields[f]);
  return text;
}

/// `25200 3840 640`
std::string level_sizes(const SolverRow& row) {
  std::string text;
  for (const long long n : row.solve.levels.unknowns)
    text += (text.empty() ? "" : " ") + std::to_string(n);
  return text;
}

std::vector<io::Cell> cells(const SolverRow& row) {
  const linear::SolveReport& s = row.solve;
  return {row.field,
          row.newton_step,
          row.setting,
          row.method,
          row.preconditioner,
          row.unknowns,
          s.iterations,
          row.convergence_factor(),
          s.true_residual,
          s.recurrence_residual,
          s.setup_seconds,
          s.solve_seconds,
          row.difference,
          row.verdict,
          level_sizes(row),
          s.levels.operator_complexity,
          s.operator_applications,
          row.refresh_seconds,
          row.memory_megabytes,
          field_residuals(row),
          row.residuals.backward_error,
          row.setup_processor_seconds,
          row.solve_processor_seconds};
}

std::vector<SolverSetting> settings_of(const Teuchos::ParameterList& list,
                                       const std::string& field) {
  const Teuchos::ParameterList& entries = list.sublist("Solvers").sublist(field);
  std::vector<SolverSetting> settings;
  for (auto it = entries.begin(); it != entries.end(); ++it)
    settings.push_back({entries.name(it), entries.sublist(entries.name(it))});
  if (list.isSublist("System")) return settings;  // none: chosen for the system
  const std::string owner = field == "System" ? "Coupling" : field;
  if (settings.empty()) settings.push_back({"case", list.sublist(owner).sublist("Linear Solver")});
  return settings;
}

std::map<std::string, std::vector<SolverSetting>> all_settings(const Teuchos::ParameterList& list) {
  if (list.isSublist("System")) return {{"system", settings_of(list, "Settings")}};
  if (coupling::CouplingSettings(list.sublist("Coupling")).is_monolithic)
    return {{"system", settings_of(list, "System")}};
  return {{"fluid", settings_of(list, "Fluid")}, {"wall", settings_of(list, "Wall")}};
}

std::map<std::string, int> place_of(const Teuchos::ParameterList& solvers) {
  std::map<std::string, int> place;
  for (const char* key : {"step", "coupling iteration"})
    if (solvers.isParameter(key)) place[key] = solvers.get<int>(key);
  return place;
}

}  // namespace

void add_setting_keys(params::Table& table) {
  foreign::add_tolerance_key(table);
  const std::string sentence = foreign::settings_sentence;
  table.entries("Fluid", problems::fluid_solver_table(), sentence)
      .entries("Wall", problems::solid_solver_table(), sentence)
      .entries("System", coupling::monolithic_solver_table(),
               "for a monolithic scheme: " + sentence);
}

namespace {

bool is_nearer(const linear::SolveReport& one, const std::optional<BestSolution>& best) {
  if (!best) return one.is_converged || one.true_residual < 1.0;
  if (one.is_converged != best->is_converged) return one.is_converged;
  return one.true_residual < best->true_residual;
}

}  // namespace

std::string note_on(const BestSolution& solution) {
  std::ostringstream text;
  text << "setting \"" << solution.setting << "\", relative residual " << solution.true_residual;
  return text.str();
}

SolverTable::SolverTable(const Teuchos::ParameterList& list, const output::RunFolder& folder,
                         const output::RunRecord& record, bool is_root)
    : settings_(all_settings(list)), tolerance_(list.sublist("Solvers").get<double>("tolerance")),
      is_chosen_(settings_.count("system") > 0 && settings_.at("system").empty()),
      direct_operations_(is_chosen_ ? list.sublist("Solvers").get<double>("direct operations")
                                    : 0.0),
      place_(place_of(list.sublist("Solvers"))), is_root_(is_root), record_(&record),
      json_file_(folder.file("solvers.json")),
      csv_(folder.file("solvers.csv"), columns(), is_root) {
  save();  // so that it never tells of an earlier run
}

std::vector<SolverSetting> SolverTable::settings_for(const LinearSystem& system) const {
  if (!is_chosen_) return settings_.at(system.field);
  const foreign::DefaultChoice choice =
      foreign::default_settings(*system.K, direct_operations_, *system.operators);
  if (is_root_) io::print_line("settings: " + foreign::in_words(choice));
  return choice.settings;
}

std::optional<BestSolution> SolverTable::run(const LinearSystem& system) {
  std::optional<BestSolution> best;
  std::optional<algebra::BlockVector> first;
  const Stopwatch watch;
  const std::vector<SolverSetting> settings = settings_for(system);
  std::size_t tried = 0;
  bool has_been_slow = false;
  for (const SolverSetting& setting : settings) {
    if (setting.is_for_slow && !has_been_slow) continue;
    ++tried;
    algebra::BlockVector x = system.K->zero();
    SolverRow row = run_setting(setting, system, tolerance_, x);
    if (row.solve.is_converged) {
      if (!first) first = x;
      row.difference = relative_difference(x, *first);
    }
    // What has converged comes before what has not, whatever its residual.
    if (is_nearer(row.solve, best))
      best = {setting.name, row.solve.true_residual, x, row.solve.is_converged, setting.list};
    add(row);
    if (is_chosen_ && row.solve.is_converged) break;
    has_been_slow = has_been_slow || row.solve.has_stagnated;
  }
  save();
  if (is_root_)
    io::print_line(
        formatted("%s: %zu settings, %g s", system.name().c_str(), tried, watch.seconds()));
  return best;
}

void SolverTable::add(const SolverRow& row) {
  csv_.row(cells(row));
  rows_.push_back(row);
}

void SolverTable::save() const {
  if (!is_root_) return;
  const Json record = Json::parse(record_->text());
  Json out;
  for (const char* section : {"program", "case", "ranks", "versions", "sizes"})
    if (record.contains(section)) out[section] = record.at(section);
  for (const auto& [key, number] : place_) out[key] = number;
  out["tolerance"] = tolerance_;
  out["solves"] = Json::array();
  for (const SolverRow& row : rows_) {
    Json& solve = out["solves"].emplace_back();
    const std::vector<io::Cell> values = cells(row);
    for (std::size_t i = 0; i < values.size(); ++i)
      std::visit([&](const auto& value) { solve[csv_.columns()[i]] = value; }, values[i]);
  }
  const Outcome written =
      io::replace_file(json_file_, out.dump(2, ' ', false, Json::error_handler_t::replace) + "\n");
  if (written.is_failure()) throw std::runtime_error(written.reason());
}

void SolverTable::print() const {
  if (!is_root_) return;
  std::string text;
  for (const auto& [field, settings] : settings_) text += text_of(rows_, field);
  io::print_line(text);
}

}  // namespace tunica::compare
