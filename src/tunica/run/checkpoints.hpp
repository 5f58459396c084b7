#pragma once
#include <functional>
#include <string>

#include "tunica/base/stop_signals.hpp"
#include "tunica/base/timer.hpp"
#include "tunica/run/time_march.hpp"

namespace tunica::run {

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

  /// Makes a step, and leaves a checkpoint of the last one that was ended where an exception that
  /// all ranks meet alike ends this one; the exception goes on. So it does where a signal ends the
  /// step in a linear solve, which is no failure. Collective, throws as end_step().
  Outcome guard(const std::function<Outcome()>& make_step);

  /// A step was accepted and its rows and fields are written: a checkpoint if one is due, or if a
  /// signal to any rank or the clock on the wall stops the march here. Collective.
  /// Throws MachineFault on all ranks if the disk refuses; the checkpoints before remain.
  void end_step();

  /// Leaves a checkpoint of the last step that was ended, where the next one was not accepted. The
  /// failure of the run. Collective, throws as end_step().
  Outcome give_up(const std::string& reason);

private:
  /// Leaves a checkpoint of the last completed step after a signal has interrupted a step.
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

}  // namespace tunica::run
