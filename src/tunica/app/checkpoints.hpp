#pragma once
#include <functional>
#include <string>

#include "tunica/app/time_march.hpp"
#include "tunica/base/stop_signals.hpp"
#include "tunica/base/timer.hpp"

namespace tunica::app {

/// The checkpoints of a run: takes the newest one where the run goes on, writes new ones as often
/// as the case wants them and where the run ends before its time, and keeps the last two.
class Checkpoints {
public:
  /// limit: seconds that the program may take. march must outlive the object.
  Checkpoints(RunOutput& output, TimeMarch& march, double limit, const CommPtr& comm);

  /// Brings the march and its parts to where the run goes on. A new run stays at its beginning and
  /// removes the checkpoints that --overwrite gives up: no later restart must take them for its
  /// own. Comes when all parts are made, and before any table is replaced. From now on all stop
  /// signals stop the run. Throws Error if the checkpoint lacks something. Collective.
  void begin();

  /// Makes the steps of the march to its end, or to one that is not accepted: make_step puts them
  /// into the tables, write_fields what they leave of fields. Where one is not accepted, or an
  /// exception that all ranks meet alike ends them, leaves a checkpoint of the last step that was
  /// ended; the exception goes on. So it does where a signal ends a step in a linear solve, which
  /// is no failure. Collective, throws as end_step().
  Outcome march(const std::function<StepSummary()>& make_step,
                const std::function<void()>& write_fields);

private:
  /// Ends a step that was accepted and is in the tables: lets it write its fields, and then a
  /// checkpoint if one is due, or if a signal to any rank or the clock on the wall stops the march
  /// here. run.json tells how long it took. Collective.
  /// Throws MachineFault on all ranks if the disk refuses; the checkpoints before remain.
  void end_step(const std::function<void()>& write_fields);

  /// Leaves a checkpoint of the last step that was ended, where the next one was not accepted. The
  /// failure of the run. Collective, throws as end_step().
  Outcome give_up(const std::string& reason);
  /// The same where a signal has ended a step before its end.
  void give_way(const StopRequest& request);
  void restore(const std::string& path) const;
  /// Why the march ends here, agreed by all ranks; empty where it does not.
  std::string why_to_stop();
  /// A checkpoint is wanted and would be newer than the newest.
  bool has_news() const;
  void write_last_ended();

  RunOutput* output_;
  TimeMarch* march_;
  double limit_;
  CommPtr comm_;
  Stopwatch run_;
  double last_ = 0.0;  ///< seconds of the run at the end of the last step
  int written_ = 0;    ///< step of the newest checkpoint, or of one that could not be written
};

}  // namespace tunica::app
