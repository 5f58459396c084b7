#pragma once
#include <string>

#include "tunica/output/checkpoint.hpp"
#include "tunica/run/domain.hpp"
#include "tunica/run/restart_changes.hpp"

namespace tunica::run {

/// From where a run goes on.
struct Restart {
  std::string file;
  output::CheckpointHead head;
  Changes changes{};  ///< of the case; on rank 0
};

/// The newest checkpoint in the folder of the case that can be read whole, and says so on the
/// screen. Throws Error if there is none, or if it does not fit: another mesh, other fields,
/// another step size. Writes nothing. Collective.
Restart find_restart(const setup::Case& the_case, const Domain& domain);

}  // namespace tunica::run
