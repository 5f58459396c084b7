#include "tunica/foreign/system_solver.hpp"

#include <Teuchos_Array.hpp>

#include "tunica/base/attempt.hpp"
#include "tunica/base/error.hpp"
#include "tunica/base/exception_summary.hpp"
#include "tunica/base/formatted.hpp"
#include "tunica/foreign/bordered_solver.hpp"
#include "tunica/foreign/refined_solve.hpp"
#include "tunica/foreign/told_rows.hpp"

namespace tunica::foreign {

namespace {

std::vector<SolverSetting> settings_for(const systems::System& system,
                                        const Teuchos::ParameterList& solvers) {
  const Teuchos::ParameterList& entries = solvers.sublist("Settings");
  std::vector<SolverSetting> settings;
  for (auto it = entries.begin(); it != entries.end(); ++it)
    settings.push_back({entries.name(it), entries.sublist(entries.name(it))});
  if (settings.empty())
    settings =
        default_settings(system.K, solvers.get<double>("direct operations"), GivenOperators(system))
            .settings;
  return settings;
}

/// The next setting is where one falls back to.
std::unique_ptr<linear::LinearSolver> solver_of(const SolverSetting& setting,
                                                const algebra::BlockMatrix& K,
                                                const linear::NamedOperators& operators) {
  Teuchos::ParameterList alone(setting.list);
  alone.set("fallbacks", Teuchos::Array<std::string>());
  return linear::make_linear_solver(alone, K, operators);
}

bool is_nearer(const linear::SolveReport& one, const std::optional<Answer>& best) {
  return !best || one.is_converged || one.true_residual < best->report.true_residual;
}

}  // namespace

SystemSolver::SystemSolver(const systems::System& system, const Teuchos::ParameterList& solvers)
    : system_(&system), operators_(system), tolerance_(solvers.get<double>("tolerance")),
      settings_(settings_for(system, solvers)) {}

std::string SystemSolver::told(const Outcome& failure) const {
  return with_rows_of_files(*system_, exception_summary(failure.reason()));
}

bool SystemSolver::prepare_next() {
  for (; present_ < settings_.size(); ++present_) {
    const SolverSetting& setting = settings_[present_];
    if (setting.is_for_slow && !has_been_slow_) continue;
    const Outcome outcome = attempt(*system_->K.comm(), "setting up \"" + setting.name + "\"", [&] {
      solver_ = with_border(*system_, solver_of(setting, system_->K, operators_));
      solver_->prepare();
    });
    if (outcome.is_success()) return true;
    failures_ += setting.name + ": " + told(outcome) + "\n";
    solver_.reset();
  }
  present_ = 0;
  return false;
}

void SystemSolver::set_up() {
  failures_.clear();
  TUNICA_CHECK(prepare_next(), "no setting can be set up: " + failures_);
}

void SystemSolver::refresh() {
  failures_.clear();
  if (!solver_) return set_up();
  const Outcome outcome = attempt(*system_->K.comm(), "setting up \"" + setting().name + "\"", [&] {
    solver_->matrix_changed();
    solver_->prepare();
  });
  if (outcome.is_success()) return;
  failures_ += setting().name + ": " + told(outcome) + "\n";
  ++present_;
  TUNICA_CHECK(prepare_next(), "no setting can be set up: " + failures_);
}

Answer SystemSolver::solve(algebra::BlockVector& y) {
  std::optional<Answer> best;
  algebra::BlockVector tried = system_->K.zero();
  for (bool is_ready = solver_ != nullptr || prepare_next(); is_ready; is_ready = prepare_next()) {
    Answer answer{{}, {}, setting().name, ""};
    const Outcome outcome = attempt(*system_->K.comm(), "trying \"" + setting().name + "\"", [&] {
      answer.report = refined_solve(*solver_, system_->b, judge_of(*system_), tolerance_, tried,
                                    answer.residuals);
    });
    if (outcome.is_success() && is_nearer(answer.report, best)) {
      best = answer;
      y.assign(tried);
    }
    if (outcome.is_success() && answer.report.is_converged) break;
    has_been_slow_ = has_been_slow_ || answer.report.has_stagnated;
    failures_ +=
        setting().name + ": " +
        (outcome.is_success() ? linear::describe_unconverged(answer.report) : told(outcome)) + "\n";
    solver_.reset();
    ++present_;
  }
  TUNICA_CHECK(best.has_value(), "no setting gives a solution: " + failures_);
  best->failures = failures_;
  failures_.clear();
  return *best;
}

}  // namespace tunica::foreign
