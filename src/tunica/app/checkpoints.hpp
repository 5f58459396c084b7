#pragma once
#include <string>
#include <utility>
#include <vector>

#include "tunica/app/run.hpp"
#include "tunica/base/timer.hpp"
#include "tunica/fields/state.hpp"
#include "tunica/stepping/clock.hpp"

namespace tunica::app {

/// The checkpoints of a run: takes the newest one where the run goes on, writes new ones as often
/// as the case wants them, and keeps the last two.
class Checkpoints {
public:
  using Parts = std::vector<std::pair<std::string, fields::Restartable*>>;

  /// The parts, which must outlive the object, are all that a run needs to go on.
  Checkpoints(RunOutput& output, const Parts& parts, const CommPtr& comm);

  /// Brings parts and clock to where the run goes on. A new run stays at its beginning and removes
  /// the checkpoints that --overwrite gives up: no later restart must take them for its own. Comes
  /// when all parts are made, and before any table is replaced. Throws Error if the checkpoint
  /// lacks something. Collective.
  void begin(stepping::Clock& clock) const;

  /// Writes the clock's step, which is accepted, if it is due. run.json tells how long it took.
  /// Collective. Throws MachineFault on all ranks if the disk refuses; the checkpoints before
  /// remain.
  void write_if_due(const stepping::Clock& clock) const;

private:
  void restore(const std::string& file) const;

  RunOutput* output_;
  Parts parts_;
  CommPtr comm_;
  Stopwatch run_;
};

}  // namespace tunica::app
