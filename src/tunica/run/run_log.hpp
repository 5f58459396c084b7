#pragma once
#include <deque>
#include <map>
#include <utility>

#include "tunica/base/timer.hpp"
#include "tunica/coupling/scheme.hpp"
#include "tunica/discretisation/observable.hpp"
#include "tunica/io/csv_table.hpp"
#include "tunica/run/run_output.hpp"

namespace tunica::run {

/// Where a row belongs.
struct IterationIndex {
  int step;
  double time;
  int coupling_iteration;  ///< 0 where there is no coupling
  int attempt = 1;         ///< of the step
};

/// Outcome of one time step, and its totals.
struct StepSummary {
  bool is_converged = false;
  bool is_accepted = false;  ///< converged, or not and accepted as the case says
  std::string reason;        ///< why not converged
  int rejected = 0;          ///< attempts before
  /// Estimated error over what is permitted; not a number where a step did not converge, nothing
  /// where nobody estimates it.
  std::optional<double> error;
  int coupling_iterations = 0;
  double interface_residual = 0.0;

  struct Solves {
    std::string field;
    int newton = 0, linear = 0;
  };
  std::vector<Solves> fields;  ///< those that the run solves for
};

/// The tables of a run, a row per step, coupling iteration, Newton step and linear solve, and
/// one line on the screen per step.
class RunLog {
public:
  /// fields: those that the run solves for by Newton's method; stages: the parts of a coupling
  /// iteration that are timed. A run that goes on keeps the rows of the steps before.
  RunLog(RunOutput& output, bool is_root, const std::vector<std::string>& fields,
         const std::vector<std::string>& stages);

  /// Rows from now on belong there.
  void begin(const IterationIndex& index);
  /// The rows of a Newton step of a field and of its linear solves, once it is made.
  void newton(const std::string& field, const nonlinear::NewtonStep& step);
  /// A coupling iteration that has ended; what follows belongs to the next one.
  void coupling(const coupling::Iteration& iteration);
  /// A line on the screen for what the run does, and for what it goes on in spite of.
  void note(const std::string& text) const;
  void warn(const std::string& text) const;
  void step(const stepping::Clock& clock, const StepSummary& summary,
            const discretisation::Observables& observables);

private:
  void open_steps(const StepSummary& summary, const discretisation::Observables& observables);
  /// ", about 12 min left" for so many steps to come, from the mean of the last ones.
  std::string time_left(double steps) const;
  void print(const stepping::Clock& clock, const StepSummary& summary) const;
  void linear_row(const std::string& field, const linear::SolveReport& l);

  output::RunRecord* record_;
  std::string steps_file_;
  bool is_root_;
  int steps_done_;
  std::unique_ptr<io::CsvTable> steps_table_;
  io::CsvTable coupling_, newton_, linear_;
  IterationIndex index_{0, 0.0, 0};
  std::map<std::string, int> newton_steps_;  ///< of a field since begin(), or since coupling()
  /// Linear solves of a field with a preconditioner.
  std::map<std::pair<std::string, std::string>, int> solves_;
  Stopwatch run_;
  double last_ = 0.0;           ///< seconds of the run at the end of the last step
  std::deque<double> seconds_;  ///< of the last steps, newest first
};

/// "12 min": as precise as an estimate deserves.
std::string rough_duration(double seconds);

StepSummary summary_of(const coupling::Report& report, const std::vector<std::string>& fields);
/// Summary for a field that is solved alone.
StepSummary summary_of(const nonlinear::NewtonReport& report, const std::string& field,
                       const stepping::Clock& clock);
/// Summary of a step that could not begin.
StepSummary summary_of(const Outcome& failure, const std::vector<std::string>& fields);

/// All observables in one list.
discretisation::Observables joined(const std::vector<discretisation::Observables>& parts);

/// Tells the unknowns of a system that Newton's method solves, and records them. Collective.
void tell_unknowns(output::RunRecord& record, const std::string& system,
                   const algebra::BlockSpace& space);

/// Notes how fast a field's Jacobians were assembled, in tetrahedra per second and rank.
/// Collective.
void record_assembly(output::RunRecord& record, const std::string& field, const Throughput& meter,
                     const Comm& comm);

}  // namespace tunica::run
