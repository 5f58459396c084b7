#pragma once
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "tunica/observe/field.hpp"
#include "tunica/problems/step_error.hpp"
#include "tunica/run/run_log.hpp"
#include "tunica/stepping/step_control.hpp"

namespace tunica::run {

using observe::Parts;

/// The step control of a case with time steps.
stepping::StepControl step_control(const setup::Case& the_case);

/// Takes a run from step to step. A step that fails, or is not accurate enough, is undone, cut and
/// repeated: every part goes back to where the step began, as in a run that is restarted there, but
/// for what a part has learnt from the failure.
class TimeMarch {
public:
  /// The parts, which must outlive the object, are all that a step changes and the next ones need.
  TimeMarch(const setup::Case& the_case, const Parts& parts, RunOutput& output);

  /// The accuracy of a field counts where steps are adaptive, how much it changes where a steady
  /// flow is sought. While it stands at its start.
  void judge(observe::Field& field);

  /// All that a run needs to go on: the parts, theirs, and what the accuracy is judged by.
  Parts parts() const;
  /// State that the control needs to continue after clock(), and its restoration.
  using Numbers = std::map<std::string, std::vector<double>>;
  Numbers save() const;
  void restore(const Numbers& numbers);

  /// Size of fixed steps [ms]; zero where they are of any.
  double fixed_step() const { return control_.fixed_step(); }
  bool is_done() const { return is_stopped_ || control_.is_done(); }
  /// No further step, although it is not done.
  void stop() { is_stopped_ = true; }
  /// Success, or that no steady flow was found where one was sought; when all steps are made.
  Outcome outcome() const;
  /// The step made last; before the first, the first.
  const stepping::Clock& clock() const { return made_; }
  /// Tries the clock's step, and accepts it where that can be done: the attempts of a step count
  /// from 1. Collective.
  using Solve = std::function<StepSummary(const stepping::Clock& clock, int attempt)>;

  /// Makes the next step. Where it is not accepted, the march is over. The record of the run counts
  /// what was repeated, or accepted in spite of something. Collective.
  StepSummary make_step(const Solve& solve, RunLog& log);

  /// Where the march stood: after that step, with the numbers of save().
  struct Place {
    int step;
    double time;
    Numbers numbers;
  };
  /// All is done with the step made last, which was accepted: it stays.
  void end_step() { is_in_step_ = false; }
  /// The last step that was ended; that before the first of this program.
  int last_ended() const;
  /// Its time [ms].
  double time_of_last() const;
  /// Goes back to the end of that step, as for a repeat, however far the next one has come. Not
  /// where that step has a checkpoint. Collective.
  Place undo();

private:
  bool is_to_repeat(StepSummary& step, const RunLog& log);
  bool is_too_inaccurate(StepSummary& step, const RunLog& log);
  void accept(const StepSummary& step);
  void tell_repeat(const RunLog& log, const std::string& reason) const;
  std::vector<fields::State> save_parts() const;
  void restore_parts() const;

  /// Steps and attempts so far, those of the run that goes on among them.
  struct Counts {
    int failed = 0, inaccurate = 0;           ///< attempts that were repeated
    int unconverged = 0, over_tolerance = 0;  ///< steps that were accepted in spite of it
  };

  RunOutput* output_;
  Parts parts_;  ///< with their parts
  stepping::StepControl control_;
  stepping::Clock made_;
  std::optional<problems::StepTolerance> tolerance_;  ///< of steps of any size
  std::vector<std::pair<std::string, std::unique_ptr<problems::StepError>>> errors_;
  std::vector<fields::State> before_;  ///< of parts(), at the start of the step made last
  Numbers numbers_before_;
  bool is_stopped_ = false, has_made_step_ = false;
  bool is_in_step_ = false;  ///< one has begun that has not ended
  double eta_ = 0.0;         ///< of the present step, see stepping::StepControl
  Counts counts_;
};

}  // namespace tunica::run
