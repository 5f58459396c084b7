#include "tunica/app/checkpoints.hpp"

#include <iostream>

#include "tunica/base/agreement.hpp"
#include "tunica/base/fault_point.hpp"
#include "tunica/output/checkpoint.hpp"
#include "tunica/output/checkpoint_series.hpp"

namespace tunica::app {

Checkpoints::Checkpoints(RunOutput& output, TimeMarch& march, const CommPtr& comm)
    : output_(&output), march_(&march), comm_(comm) {}

void Checkpoints::begin() const {
  const auto& restart = output_->restart;
  if (restart) restore(restart->file);
  if (restart) march_->restore(restart->head.control);
  if (comm_->getRank() == 0)
    output::prune_checkpoints(output_->folder.path(), output_->steps_done(),
                              restart ? output::kept_checkpoints : 0);
}

void Checkpoints::restore(const std::string& file) const {
  for (const auto& [name, part] : march_->parts()) {
    const std::vector<int> vertices = part->save().vertices;
    fields::State state;
    on_all(*comm_, [&, &n = name] { state = output::CheckpointFile(file).read(n, vertices); });
    const std::string remark = part->restore(state);
    if (!remark.empty() && comm_->getRank() == 0) std::cout << remark << std::endl;
  }
}

void Checkpoints::write_if_due() const {
  const stepping::Clock& clock = march_->clock();
  const int every = output_->checkpoint_every;
  if (every == 0 || (!clock.is_every(every) && !clock.is_last())) return;
  const Stopwatch writing;
  fault_point("checkpoint");
  const double before = output_->restart ? output_->restart->head.seconds : 0.0;
  const output::CheckpointHead head{
      output_->fingerprint,    clock.step(),   clock.time(),       march_->fixed_step(),
      before + run_.seconds(), march_->save(), output_->parameters};
  output::States states;
  for (const auto& [name, part] : march_->parts()) states.emplace_back(name, part->save());
  const std::string& folder = output_->folder.path();
  output::write_checkpoint(output::checkpoint_path(folder, clock.step()), head, states, comm_);
  if (comm_->getRank() == 0)
    output::prune_checkpoints(folder, clock.step(), output::kept_checkpoints);
  output_->record.add_time("checkpoints", writing.seconds());
}

}  // namespace tunica::app
