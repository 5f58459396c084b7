#include "tunica/run/restart.hpp"

#include <cmath>
#include <sstream>

#include "tunica/base/agreement.hpp"
#include "tunica/base/error.hpp"
#include "tunica/base/formatted.hpp"
#include "tunica/io/messages.hpp"
#include "tunica/output/checkpoint_series.hpp"

namespace tunica::run {

namespace {

/// Path of the newest checkpoint that holds what it promises. On one rank.
std::string newest_whole(const std::string& folder) {
  const auto series = output::checkpoints_in(folder);
  TUNICA_CHECK(!series.empty(), "--restart: the folder \"" + folder +
                                    "\" has no checkpoint. Name the folder of the run with "
                                    "--output, or begin anew without --restart.");
  std::string reason;
  for (const output::NamedCheckpoint& checkpoint : series) {
    try {
      const output::CheckpointFile file(checkpoint.path);
      TUNICA_CHECK(file.head().step == checkpoint.step,
                   checkpoint.path + ": it is of step " + std::to_string(file.head().step));
      file.verify();
      return checkpoint.path;
    } catch (const Error& error) {
      io::print_line("checkpoint of step " + std::to_string(checkpoint.step) +
                     " is unusable: " + error.what());
      if (reason.empty()) reason = error.what();
    }
  }
  throw Error("--restart: no checkpoint in \"" + folder + "\" can be used: " + reason +
              ". Begin anew with --overwrite.");
}

/// "fluid and wall"
std::string fields_text(bool has_fluid, bool has_wall) {
  return has_fluid && has_wall ? "fluid and wall" : has_fluid ? "a fluid alone" : "a wall alone";
}

void check_fit(const output::CheckpointFile& file, const std::string& path,
               const setup::Case& the_case, const Domain& domain) {
  const bool has_fluid = domain.has("fluid"), has_wall = domain.has("wall");
  TUNICA_CHECK(file.has("fluid") == has_fluid && file.has("wall") == has_wall,
               "--restart: " + path + " holds " + fields_text(file.has("fluid"), file.has("wall")) +
                   ", but this case has " + fields_text(has_fluid, has_wall) + ".");
  TUNICA_CHECK(file.head().mesh == domain.fingerprint,
               "--restart: " + path + " belongs to another mesh than " + the_case.mesh->file +
                   ". A run continues with the mesh it began with.");
  if (the_case.coupling) {
    const std::string& scheme = the_case.coupling->scheme;
    const std::string& former = file.text("coupling/scheme");
    TUNICA_CHECK(former == scheme, "--restart: " + path + " was made with Coupling / scheme = \"" +
                                       former + "\", not \"" + scheme +
                                       "\". A run continues with the one it began with.");
  }
  TUNICA_CHECK(!file.head().control.empty(),
               "--restart: " + path + " lacks the state of the step control.");
  const auto& was = file.head().control;
  const std::string kind = file.head().step_size > 0.0     ? "fixed"
                           : was.at("pseudo-time").empty() ? "adaptive"
                                                           : "steady";
  const std::string& wanted = the_case.time->step_control;
  TUNICA_CHECK(kind == wanted, "--restart: " + path + " was made with \"step control\" = \"" +
                                   kind + "\", not \"" + wanted +
                                   "\". A run continues with the one it began with.");
  if (kind != "fixed") return;
  const double step_size = the_case.time->steps.first_step;
  std::ostringstream sizes;
  sizes.precision(13);  // sizes that differ by less are taken for equal
  sizes << "Time: \"step size\" is " << step_size << " ms, but " << path << " was made with "
        << file.head().step_size << " ms. A run continues with the step size it began with.";
  TUNICA_CHECK(std::abs(step_size - file.head().step_size) <= 1e-12 * step_size, sizes.str());
}

}  // namespace

Restart find_restart(const setup::Case& the_case, const Domain& domain) {
  const CommPtr& comm = domain.comm;
  Restart restart;
  on_root(*comm, [&] { restart.file = newest_whole(the_case.output.folder); });
  broadcast(*comm, restart.file);
  on_all(*comm, [&] {
    const output::CheckpointFile file(restart.file);
    check_fit(file, restart.file, the_case, domain);
    restart.head = file.head();
  });
  if (comm->getRank() == 0)
    io::print_line(
        formatted("restart after step %d (t %g ms) from ", restart.head.step, restart.head.time) +
        restart.file);
  return restart;
}

}  // namespace tunica::run
