#include "tunica/app/run_log.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <numeric>
#include <sstream>

#include "tunica/base/reduce.hpp"

namespace tunica::app {

RunLog::RunLog(const RunOutput& output, bool is_root, int steps)
    : steps_file_(output.folder.file("steps.csv")), is_root_(is_root), steps_(steps),
      steps_done_(output.steps_done()),
      coupling_(output.folder.file("coupling.csv"),
                {"step", "time", "iteration", "interface_residual", "relaxation", "columns",
                 "fluid_newton", "wall_newton", "fluid_linear", "wall_linear", "motion_seconds",
                 "fluid_seconds", "wall_seconds", "update_seconds"},
                is_root, output.steps_done()),
      newton_(output.folder.file("newton.csv"),
              {"step", "coupling_iteration", "field", "iteration", "increment",
               "relative_increment", "residual", "exponent", "step_length", "linear_tolerance",
               "linear_residual", "linear_iterations"},
              is_root, output.steps_done()),
      linear_(output.folder.file("linear.csv"),
              {"step", "coupling_iteration", "field", "newton_iteration", "method", "iterations",
               "tolerance", "recurrence_residual", "true_residual", "setup_seconds",
               "solve_seconds", "converged"},
              is_root, output.steps_done()) {}

void RunLog::newton(const IterationIndex& moment, const std::string& field,
                    const nonlinear::NewtonReport& report) {
  for (std::size_t k = 0; k < report.steps.size(); ++k) {
    const nonlinear::NewtonStep& s = report.steps[k];
    const auto iteration = static_cast<long long>(k + 1);
    const linear::SolveReport& l = s.linear;
    newton_.row({moment.step, moment.coupling_iteration, field, iteration, s.increment,
                 s.relative_increment, s.residual, s.exponent, s.step_length, l.tolerance,
                 l.true_residual, l.iterations});
    linear_.row({moment.step, moment.coupling_iteration, field, iteration, l.method, l.iterations,
                 l.tolerance, l.recurrence_residual, l.true_residual, l.setup_seconds,
                 l.solve_seconds, l.is_converged});
  }
}

void RunLog::coupling(const IterationIndex& moment, const coupling::Iteration& iteration) {
  coupling_.row({moment.step, moment.time, moment.coupling_iteration, iteration.residual,
                 iteration.relaxation, iteration.columns,
                 static_cast<long long>(iteration.fluid.steps.size()),
                 static_cast<long long>(iteration.wall.steps.size()),
                 iteration.fluid.linear_iterations(), iteration.wall.linear_iterations(),
                 iteration.motion_seconds, iteration.fluid_seconds, iteration.wall_seconds,
                 iteration.update_seconds});
  newton(moment, "fluid", iteration.fluid);
  newton(moment, "wall", iteration.wall);
}

void RunLog::open_steps(const problems::Observables& observables) {
  std::vector<std::string> columns{
      "step",         "time",        "converged",    "coupling_iterations", "interface_residual",
      "fluid_newton", "wall_newton", "fluid_linear", "wall_linear",         "seconds"};
  for (const problems::Observable& o : observables) columns.push_back(o.name);
  steps_table_ = std::make_unique<io::CsvTable>(steps_file_, columns, is_root_, steps_done_);
}

void RunLog::warn(const std::string& text) const {
  if (is_root_) std::fprintf(stderr, "warning: %s\n", text.c_str());
}

void RunLog::step(const IterationIndex& moment, const StepSummary& s,
                  const problems::Observables& observables) {
  if (!steps_table_) open_steps(observables);
  const double now = run_.seconds();
  std::vector<io::Cell> row{
      moment.step,    moment.time,   s.is_converged, s.coupling_iterations, s.interface_residual,
      s.fluid_newton, s.wall_newton, s.fluid_linear, s.wall_linear,         now - last_};
  for (const problems::Observable& o : observables) row.emplace_back(o.value);
  steps_table_->row(row);
  seconds_.push_front(now - last_);
  last_ = now;
  print(moment, s);
}

std::string RunLog::time_left(int steps) const {
  // The first step of a program sets up its solvers and tells little of the others.
  const std::size_t known = std::min<std::size_t>(seconds_.size() - 1, 5);
  if (known == 0 || steps == 0) return "";
  const double sum = std::accumulate(seconds_.begin(), seconds_.begin() + known, 0.0);
  return ", about " + rough_duration(sum / static_cast<double>(known) * steps) + " left";
}

void RunLog::print(const IterationIndex& moment, const StepSummary& s) const {
  if (!is_root_) return;
  std::printf("step %d/%d  t %g ms", moment.step, steps_, moment.time);
  if (s.coupling_iterations > 0) std::printf("  coupling %d", s.coupling_iterations);
  if (s.coupling_iterations > 0 && std::isfinite(s.interface_residual))
    std::printf(" (|r| %.1e mm)", s.interface_residual);
  const auto print_field = [](const char* name, int newton, int linear) {
    if (newton > 0) std::printf("  %s %d Newton %d linear", name, newton, linear);
  };
  print_field("fluid", s.fluid_newton, s.fluid_linear);
  print_field("wall", s.wall_newton, s.wall_linear);
  std::printf("  %.2f s%s%s\n", seconds_.front(), time_left(steps_ - moment.step).c_str(),
              s.is_converged ? "" : "  NOT CONVERGED");
  std::fflush(stdout);
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

StepSummary summary_of(const coupling::Report& report) {
  using coupling::Iteration;
  return {report.is_converged,
          static_cast<int>(report.iterations.size()),
          report.iterations.empty() ? 0.0 : report.iterations.back().residual,
          report.newton_steps(&Iteration::fluid),
          report.newton_steps(&Iteration::wall),
          report.linear_iterations(&Iteration::fluid),
          report.linear_iterations(&Iteration::wall)};
}

StepSummary fluid_summary(const nonlinear::NewtonReport& report) {
  StepSummary summary;
  summary.is_converged = report.is_converged;
  summary.fluid_newton = static_cast<int>(report.steps.size());
  summary.fluid_linear = report.linear_iterations();
  return summary;
}

StepSummary wall_summary(const nonlinear::NewtonReport& report) {
  StepSummary summary;
  summary.is_converged = report.is_converged;
  summary.wall_newton = static_cast<int>(report.steps.size());
  summary.wall_linear = report.linear_iterations();
  return summary;
}

Outcome failure(const stepping::Clock& clock, const std::string& field,
                const nonlinear::NewtonReport& report) {
  std::ostringstream text;
  text << "time " << clock.time() << " ms: Newton's method of " << field << ": " << report.reason;
  return Outcome::failure(text.str());
}

problems::Observables joined(const std::vector<problems::Observables>& parts) {
  problems::Observables all;
  for (const problems::Observables& part : parts) all.insert(all.end(), part.begin(), part.end());
  return all;
}

void record_assembly(output::RunRecord& record, const std::string& field, const Throughput& meter,
                     const Comm& comm) {
  const double items = global_sum(comm, static_cast<double>(meter.items));
  const double seconds = global_sum(comm, meter.seconds);
  record.add_time("assembly of " + field + " Jacobians", seconds / comm.getSize());
  record.set("assembly", field + " tetrahedra per second and rank",
             seconds > 0.0 ? items / seconds : 0.0);
}

}  // namespace tunica::app
