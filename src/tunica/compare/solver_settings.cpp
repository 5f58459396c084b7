#include "tunica/compare/solver_settings.hpp"

#include <Teuchos_Array.hpp>
#include <algorithm>
#include <cmath>

#include "tunica/base/attempt.hpp"
#include "tunica/base/exception_summary.hpp"
#include "tunica/base/heap.hpp"
#include "tunica/base/reduce.hpp"
#include "tunica/base/timer.hpp"
#include "tunica/foreign/bordered_solver.hpp"
#include "tunica/foreign/refined_solve.hpp"
#include "tunica/foreign/told_rows.hpp"

namespace tunica::compare {

namespace {

std::string verdict_of(const SolverSetting& setting, const linear::SolveReport& solve) {
  if (solve.is_converged) return "converged";
  if (!std::isfinite(solve.recurrence_residual)) return "breakdown";
  if (!(solve.true_residual < 1.0)) return "diverged";
  if (solve.recurrence_residual <= solve.tolerance) return "drifted";
  const bool has_cap = setting.list.isParameter("max iterations");
  return has_cap && solve.iterations >= setting.list.get<int>("max iterations") ? "cap"
                                                                                : "stagnated";
}

/// Systems of a coupled problem are solved as a run solves them, without refinement.
linear::SolveReport solve_and_judge(linear::LinearSolver& solver, const LinearSystem& system,
                                    double tolerance, algebra::BlockVector& x,
                                    Residuals& residuals) {
  if (system.of_files != nullptr)
    return foreign::refined_solve(solver, *system.b, foreign::judge_of(*system.of_files), tolerance,
                                  x, residuals);
  const linear::SolveReport report = solver.solve(*system.b, x, tolerance);
  residuals = foreign::residuals_of(*system.K, *system.b, x);
  return report;
}

double norm_of_difference(const Vector& x, const Vector& y) {
  Vector difference(x, Teuchos::Copy);
  difference.update(-1.0, y, 1.0);
  return difference.norm2();
}

/// What is known of a row before the setting is tried.
SolverRow untried(const SolverSetting& setting, const LinearSystem& system) {
  SolverRow row;
  row.field = system.field;
  row.newton_step = system.newton_step;
  row.setting = setting.name;
  row.method = setting.list.get<std::string>("method");
  if (setting.list.isParameter("preconditioner"))
    row.preconditioner = setting.list.get<std::string>("preconditioner");
  row.unknowns = system.K->n_unknowns();
  for (int b = 0; b < system.K->n_blocks(); ++b) row.fields.push_back((*system.K->space())[b].name);
  row.solve.true_residual = row.solve.recurrence_residual =
      std::numeric_limits<double>::quiet_NaN();
  return row;
}

}  // namespace

double SolverRow::convergence_factor() const {
  if (solve.iterations == 0) return std::numeric_limits<double>::quiet_NaN();
  return std::pow(solve.true_residual, 1.0 / solve.iterations);
}

SolverRow run_setting(const SolverSetting& setting, const LinearSystem& system, double tolerance,
                      algebra::BlockVector& x) {
  const Comm& comm = *system.K->comm();
  SolverRow row = untried(setting, system);
  Teuchos::ParameterList alone(setting.list);
  alone.set("fallbacks", Teuchos::Array<std::string>());  // it shows what it does itself
  comm.barrier();
  const Stopwatch watch;
  const double heap_before = heap_bytes();
  double held = 0.0, setup_seconds = 0.0;
  const ProcessorWatch setting_up;
  const Outcome outcome = attempt(comm, "trying \"" + setting.name + "\"", [&] {
    auto solver = linear::make_linear_solver(alone, *system.K, *system.operators);
    if (system.of_files != nullptr)
      solver = foreign::with_border(*system.of_files, std::move(solver));
    solver->prepare();
    setup_seconds = watch.seconds();
    row.setup_processor_seconds = setting_up.seconds();
    solver->prepare();
    row.refresh_seconds = watch.seconds() - setup_seconds;
    const ProcessorWatch solving;
    row.solve = solve_and_judge(*solver, system, tolerance, x, row.residuals);
    row.solve_processor_seconds = solving.seconds();
    held = heap_bytes() - heap_before;
  });
  row.solve.setup_seconds = global_max(comm, setup_seconds);
  row.refresh_seconds = global_max(comm, row.refresh_seconds);
  row.solve.solve_seconds = global_max(comm, row.solve.solve_seconds);
  if (outcome.is_failure()) row.setup_processor_seconds = setting_up.seconds();
  row.setup_processor_seconds = global_sum(comm, row.setup_processor_seconds);
  row.solve_processor_seconds = global_sum(comm, row.solve_processor_seconds);
  row.memory_megabytes = global_sum(comm, held) / 1e6;
  row.verdict =
      outcome.is_success() ? verdict_of(setting, row.solve) : exception_summary(outcome.reason());
  if (outcome.is_failure() && system.of_files != nullptr)
    row.verdict = foreign::with_rows_of_files(*system.of_files, row.verdict);
  row.solve.is_converged = row.verdict == "converged";
  row.is_at_rounding =
      row.solve.is_converged && system.of_files != nullptr && row.residuals.are_rounding(tolerance);
  return row;
}

double relative_difference(const algebra::BlockVector& x, const algebra::BlockVector& y) {
  const auto part = [](const Vector& a, const Vector& b) {
    const double difference = norm_of_difference(a, b), size = b.norm2();
    return size > 0.0 ? difference / size : difference;
  };
  double largest = 0.0;
  for (int b = 0; b < x.n_blocks(); ++b) largest = std::max(largest, part(x[b], y[b]));
  return largest;
}

}  // namespace tunica::compare
