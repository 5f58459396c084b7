#include "tunica/run/run_log.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <sstream>

#include "tunica/base/fault_point.hpp"
#include "tunica/base/formatted.hpp"
#include "tunica/base/reduce.hpp"
#include "tunica/io/messages.hpp"
#include "tunica/io/progress.hpp"

namespace tunica::run {

namespace {

/// name_suffix for every name.
void append(std::vector<std::string>& columns, const std::vector<std::string>& names,
            const std::string& suffix) {
  for (const std::string& name : names) columns.push_back(name + suffix);
}

std::vector<std::string> coupling_columns(const std::vector<std::string>& fields,
                                          const std::vector<std::string>& stages) {
  std::vector<std::string> columns{
      "step", "time", "attempt", "iteration", "interface_residual", "relaxation", "columns"};
  append(columns, fields, "_newton");
  append(columns, fields, "_linear");
  append(columns, stages, "_seconds");
  return columns;
}

/// "fill 0 shift 0 radius 1.32 damping 1; …" of each level, the finest first.
std::string smoothers_text(const multigrid::Levels& levels) {
  std::string text;
  for (const multigrid::SmootherState& s : levels.smoothers)
    text += (text.empty() ? "" : "; ") + formatted("fill %d shift %g radius %.3g damping %.3g",
                                                   s.fill, s.shift, s.radius, s.damping);
  return text;
}

}  // namespace

RunLog::RunLog(RunOutput& output, bool is_root, const std::vector<std::string>& fields,
               const std::vector<std::string>& stages)
    : record_(&output.record), steps_file_(output.folder.file("steps.csv")), is_root_(is_root),
      steps_done_(output.steps_done()),
      coupling_(output.folder.file("coupling.csv"), coupling_columns(fields, stages), is_root,
                output.steps_done()),
      newton_(output.folder.file("newton.csv"),
              {"step", "attempt", "coupling_iteration", "field", "iteration", "increment",
               "relative_increment", "residual", "exponent", "step_length", "linear_tolerance",
               "linear_residual", "linear_iterations"},
              is_root, output.steps_done()),
      linear_(output.folder.file("linear.csv"),
              {"step", "attempt", "coupling_iteration", "field", "newton_iteration", "method",
               "preconditioner", "iterations", "tolerance", "recurrence_residual", "true_residual",
               "setup_seconds", "solve_seconds", "converged", "smoothers"},
              is_root, output.steps_done()) {}

void RunLog::begin(const IterationIndex& index) {
  index_ = index;
  newton_steps_.clear();
}

void RunLog::newton(const std::string& field, const nonlinear::NewtonStep& s) {
  const int iteration = ++newton_steps_[field];
  const linear::SolveReport& l = s.linear;
  newton_.row({index_.step, index_.attempt, index_.coupling_iteration, field, iteration,
               s.increment, s.relative_increment, s.residual, s.exponent, s.step_length,
               l.tolerance, l.true_residual, l.iterations});
  for (const linear::SolveReport& attempt : l.attempts) linear_row(field, attempt);
  if (l.attempts.empty()) linear_row(field, l);
}

void RunLog::linear_row(const std::string& field, const linear::SolveReport& l) {
  linear_.row({index_.step, index_.attempt, index_.coupling_iteration, field, newton_steps_[field],
               l.method, l.preconditioner, l.iterations, l.tolerance, l.recurrence_residual,
               l.true_residual, l.setup_seconds, l.solve_seconds, l.is_converged,
               smoothers_text(l.levels)});
  ++solves_[{field, l.preconditioner}];
}

void RunLog::coupling(const coupling::Iteration& iteration) {
  std::vector<io::Cell> row{
      index_.step,        index_.time,          index_.attempt,   index_.coupling_iteration,
      iteration.residual, iteration.relaxation, iteration.columns};
  for (const coupling::FieldSolve& solve : iteration.solves)
    row.emplace_back(static_cast<long long>(solve.report.steps.size()));
  for (const coupling::FieldSolve& solve : iteration.solves)
    row.emplace_back(static_cast<long long>(solve.report.linear_iterations()));
  for (const coupling::Stage& stage : iteration.stages) row.emplace_back(stage.seconds);
  coupling_.row(row);
  ++index_.coupling_iteration;
  newton_steps_.clear();
}

void RunLog::open_steps(const StepSummary& summary,
                        const discretisation::Observables& observables) {
  std::vector<std::string> columns{
      "step",      "time",    "converged", "coupling_iterations", "interface_residual",
      "step_size", "rejected"};
  if (summary.error) columns.emplace_back("error_estimate");
  for (const StepSummary::Solves& field : summary.fields)
    columns.push_back(field.field + "_newton");
  for (const StepSummary::Solves& field : summary.fields)
    columns.push_back(field.field + "_linear");
  columns.push_back("seconds");
  for (const discretisation::Observable& o : observables) columns.push_back(o.name);
  steps_table_ = std::make_unique<io::CsvTable>(steps_file_, columns, is_root_, steps_done_);
}

void RunLog::note(const std::string& text) const {
  if (is_root_) io::print_line(text);
  io::restart_progress_interval();
}

void RunLog::warn(const std::string& text) const {
  if (is_root_) io::print_error_line("warning: " + text);
}

void RunLog::step(const stepping::Clock& clock, const StepSummary& s,
                  const discretisation::Observables& observables) {
  fault_point("steps table");
  if (!steps_table_) open_steps(s, observables);
  const double now = run_.seconds();
  std::vector<io::Cell> row{
      clock.step(),         clock.time(),      s.is_converged, s.coupling_iterations,
      s.interface_residual, clock.step_size(), s.rejected};
  if (s.error) row.emplace_back(*s.error);
  for (const StepSummary::Solves& field : s.fields) row.emplace_back(field.newton);
  for (const StepSummary::Solves& field : s.fields) row.emplace_back(field.linear);
  row.emplace_back(now - last_);
  for (const discretisation::Observable& o : observables) row.emplace_back(o.value);
  steps_table_->row(row);
  seconds_.push_front(now - last_);
  if (seconds_.size() > 6) seconds_.pop_back();
  last_ = now;
  print(clock, s);
  for (const auto& [what, count] : solves_)
    record_->set("linear solves", what.first + ", " + what.second, count);
  if (s.is_accepted && !s.is_converged) warn(s.reason);
}

std::string RunLog::time_left(double steps) const {
  // The first step of a program sets up its solvers and tells little of the others.
  const std::size_t known = std::min<std::size_t>(seconds_.size() - 1, 5);
  if (known == 0 || steps < 0.5) return "";
  const double sum = std::accumulate(seconds_.begin(), seconds_.begin() + known, 0.0);
  return ", about " + rough_duration(sum / static_cast<double>(known) * steps) + " left";
}

void RunLog::print(const stepping::Clock& clock, const StepSummary& s) const {
  if (!is_root_) return;
  std::string line = formatted("step %d", clock.step());
  if (clock.steps() > 0 && clock.count() == clock.step())
    line += formatted("/%d  t %g ms", clock.steps(), clock.time());
  else
    line += formatted("  t %g/%g ms, %+.2g", clock.time(), clock.end(), clock.step_size());
  if (s.coupling_iterations > 0) line += formatted("  coupling %d", s.coupling_iterations);
  if (s.coupling_iterations > 0 && std::isfinite(s.interface_residual))
    line += formatted(" (|r| %.1e mm)", s.interface_residual);
  for (const StepSummary::Solves& field : s.fields)
    if (field.newton > 0)
      line +=
          formatted("  %s %d Newton %d linear", field.field.c_str(), field.newton, field.linear);
  line += formatted("  %.2f s%s%s", seconds_.front(),
                    time_left((clock.end() - clock.time()) / clock.step_size()).c_str(),
                    s.is_converged ? "" : "  NOT CONVERGED");
  io::print_line(line);
  io::restart_progress_interval();
}

std::string rough_duration(double seconds) {
  const auto text = [seconds](double unit, const char* name) {
    return std::to_string(std::max(1L, std::lround(seconds / unit))) + name;
  };
  if (seconds < 90.0) return text(1.0, " s");
  if (seconds < 90.0 * 60.0) return text(60.0, " min");
  if (seconds < 48.0 * 3600.0) return text(3600.0, " h");
  return text(24.0 * 3600.0, " days");
}

StepSummary summary_of(const coupling::Report& report, const std::vector<std::string>& fields) {
  StepSummary summary;
  summary.is_converged = report.is_converged;
  summary.is_accepted = report.is_accepted;
  summary.reason = report.reason;
  summary.coupling_iterations = static_cast<int>(report.iterations.size());
  if (!report.iterations.empty()) summary.interface_residual = report.iterations.back().residual;
  for (const std::string& field : fields)
    summary.fields.push_back({field, report.newton_steps(field), report.linear_iterations(field)});
  return summary;
}

StepSummary summary_of(const nonlinear::NewtonReport& report, const std::string& field,
                       const stepping::Clock& clock) {
  StepSummary summary;
  summary.is_converged = summary.is_accepted = report.is_converged;
  std::ostringstream reason;
  reason << "time " << clock.time() << " ms: Newton's method of the " << field << ": "
         << report.reason;
  if (!report.is_converged) summary.reason = reason.str();
  summary.fields.push_back(
      {field, static_cast<int>(report.steps.size()), report.linear_iterations()});
  return summary;
}

StepSummary summary_of(const Outcome& failure, const std::vector<std::string>& fields) {
  StepSummary summary;
  summary.reason = failure.reason();
  for (const std::string& field : fields) summary.fields.push_back({field});
  return summary;
}

discretisation::Observables joined(const std::vector<discretisation::Observables>& parts) {
  discretisation::Observables all;
  for (const discretisation::Observables& part : parts)
    all.insert(all.end(), part.begin(), part.end());
  return all;
}

void tell_unknowns(output::RunRecord& record, const std::string& system,
                   const algebra::BlockSpace& space) {
  const long long count = space.n_unknowns();
  record.set("sizes", system + " unknowns", count);
  if (space.comm()->getRank() == 0)
    io::print_line("unknowns of the " + system + ": " + std::to_string(count));
}

void record_assembly(output::RunRecord& record, const std::string& field, const Throughput& meter,
                     const Comm& comm) {
  const double items = global_sum(comm, static_cast<double>(meter.items));
  const double seconds = global_sum(comm, meter.seconds);
  record.add_time("assembly of " + field + " Jacobians", seconds / comm.getSize());
  record.set("assembly", field + " tetrahedra per second and rank",
             seconds > 0.0 ? items / seconds : 0.0);
}

}  // namespace tunica::run
