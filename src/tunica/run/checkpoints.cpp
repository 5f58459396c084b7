#include "tunica/run/checkpoints.hpp"

#include <optional>
#include <sstream>

#include "tunica/base/agreement.hpp"
#include "tunica/base/error.hpp"
#include "tunica/base/failed_ranks.hpp"
#include "tunica/base/fault_point.hpp"
#include "tunica/base/reduce.hpp"
#include "tunica/base/stop_signals.hpp"
#include "tunica/io/fatal_signals.hpp"
#include "tunica/io/messages.hpp"
#include "tunica/output/checkpoint.hpp"
#include "tunica/output/checkpoint_series.hpp"

namespace tunica::run {

namespace {

/// Seconds: more than a checkpoint takes, less than a job may wait for nothing.
constexpr unsigned patience_with_checkpoint = 900;

}  // namespace

Checkpoints::Checkpoints(RunOutput& output, TimeMarch& march, double limit, const CommPtr& comm)
    : output_(&output), march_(&march), limit_(limit), comm_(comm), written_(output.steps_done()) {}

void Checkpoints::begin() {
  const auto& restart = output_->restart;
  if (restart) restore(restart->file);
  if (restart) march_->restore(restart->head.control);
  if (comm_->getRank() == 0)
    output::prune_checkpoints(output_->folder.path(), output_->steps_done(),
                              restart ? output::kept_checkpoints : 0);
  catch_stop_signals();
}

void Checkpoints::restore(const std::string& path) const {
  std::optional<output::CheckpointFile> file;
  on_all(*comm_, [&] { file.emplace(path); });
  for (const auto& [name, part] : march_->parts()) {
    if (part->may_be_missing() && !file->has(name)) continue;
    const std::string remark = part->restore(file->read(name, part->save().places, comm_));
    if (!remark.empty() && comm_->getRank() == 0) io::print_line(remark);
  }
}

std::string Checkpoints::why_to_stop() {
  constexpr int by_the_clock = 1 << 20;  // beyond all signals
  const double now = output_->since_start.seconds(), step = run_.seconds() - last_;
  last_ = run_.seconds();
  const int mine = now + step > limit_ ? by_the_clock : stop_signal();
  const int wish = static_cast<int>(global_max(*comm_, mine));
  if (wish == 0 || march_->is_done()) return "";
  std::ostringstream text;
  text << "stopped by " << (wish == by_the_clock ? "\"wall limit\"" : signal_name(wish))
       << " after step " << march_->clock().step() << ", at " << march_->clock().time() << " ms";
  text << (output_->settings.checkpoint_every > 0
               ? ". Continue with --restart."
               : ", without a checkpoint, since \"checkpoint every\" is 0.");
  return text.str();
}

Outcome Checkpoints::guard(const std::function<Outcome()>& make_step) {
  try {
    return make_step();
  } catch (const StopRequest& request) {
    give_way(request);
    return Outcome::success();
  } catch (...) {
    if (has_news())
      do_if_all_fail_alike(*comm_, march_->last_ended(), [this] {
        const io::Deadline deadline(patience_with_checkpoint, words_of_exception());
        write_last_ended();
      });
    throw;
  }
}

void Checkpoints::end_step() {
  const stepping::Clock& clock = march_->clock();
  const int every = output_->settings.checkpoint_every;
  output_->stopped = why_to_stop();
  const bool is_stopped = !output_->stopped.empty();
  if (is_stopped) march_->stop();
  if (every > 0 && (clock.is_every(every) || clock.is_last() || is_stopped)) write_last_ended();
}

void Checkpoints::give_way(const StopRequest& request) {
  const int ended = march_->last_ended();
  std::ostringstream text;
  text << "stopped by " << signal_name(request.signal);
  if (ended > 0) text << " after step " << ended << ",";
  text << " within step " << ended + 1;
  if (output_->settings.checkpoint_every == 0)
    text << ", without a checkpoint, since \"checkpoint every\" is 0.";
  else if (ended == 0)
    text << ", before there was a step to continue from.";
  else
    text << ". Continue with --restart.";
  output_->stopped = text.str();
  march_->stop();
  if (has_news()) write_last_ended();
}

Outcome Checkpoints::give_up(const std::string& reason) {
  if (has_news()) write_last_ended();
  return Outcome::failure(reason);
}

bool Checkpoints::has_news() const {
  return output_->settings.checkpoint_every > 0 && march_->last_ended() > written_;
}

void Checkpoints::write_last_ended() {
  const Stopwatch writing;
  written_ = march_->last_ended();  // a disk that refuses is not asked again
  const TimeMarch::Place place = march_->undo();
  fault_point("checkpoint");
  const double before = output_->restart ? output_->restart->head.seconds : 0.0;
  output::CheckpointHead head;
  head.mesh = output_->fingerprint;
  head.step = place.step;
  head.time = place.time;
  head.step_size = march_->fixed_step();
  head.seconds = before + run_.seconds();
  head.control = place.numbers;
  head.parameters = output_->parameters;
  head.files = output_->files;
  output::StateSources states;
  for (const auto& [name, part] : march_->parts())
    states.emplace_back(name, [part = part] { return part->save(); });
  const std::string& folder = output_->folder.path();
  output::write_checkpoint(output::checkpoint_path(folder, place.step), head, states, comm_);
  if (comm_->getRank() == 0)
    output::prune_checkpoints(folder, place.step, output::kept_checkpoints);
  output_->record.add_time("checkpoints", writing.seconds());
}

}  // namespace tunica::run
