#pragma once
#include <string>

#include "tunica/app/time_march.hpp"
#include "tunica/base/timer.hpp"

namespace tunica::app {

/// The checkpoints of a run: takes the newest one where the run goes on, writes new ones as often
/// as the case wants them, and keeps the last two.
class Checkpoints {
public:
  /// march must outlive the object.
  Checkpoints(RunOutput& output, TimeMarch& march, const CommPtr& comm);

  /// Brings the march and its parts to where the run goes on. A new run stays at its beginning and
  /// removes the checkpoints that --overwrite gives up: no later restart must take them for its
  /// own. Comes when all parts are made, and before any table is replaced. Throws Error if the
  /// checkpoint lacks something. Collective.
  void begin() const;

  /// Writes the last step of the march if it is due. run.json tells how long it took.
  /// Collective. Throws MachineFault on all ranks if the disk refuses; the checkpoints before
  /// remain.
  void write_if_due() const;

private:
  void restore(const std::string& file) const;

  RunOutput* output_;
  TimeMarch* march_;
  CommPtr comm_;
  Stopwatch run_;
};

}  // namespace tunica::app
