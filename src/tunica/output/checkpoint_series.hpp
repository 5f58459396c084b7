#pragma once
#include <string>
#include <vector>

namespace tunica::output {

/// A checkpoint of a folder: "checkpoint-000016.h5" is that of step 16.
struct NamedCheckpoint {
  int step;
  std::string path;
};

/// How many of them a run keeps: should one be damaged, there is another.
constexpr int kept_checkpoints = 2;

std::string checkpoint_path(const std::string& folder, int step);

/// The checkpoints of a folder, newest first. Not collective.
std::vector<NamedCheckpoint> checkpoints_in(const std::string& folder);

/// Removes all but the newest `count` checkpoints up to `last_step`, with everything that a killed
/// run began to write of others. Not collective.
void prune_checkpoints(const std::string& folder, int last_step, int count);

}  // namespace tunica::output
