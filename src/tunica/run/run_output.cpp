#include "tunica/run/run_output.hpp"

#include <filesystem>

#include "tunica/base/agreement.hpp"
#include "tunica/io/atomic_file.hpp"
#include "tunica/params/read_xml.hpp"
#include "tunica/run/restart_changes.hpp"
#include "tunica/run/results_folder.hpp"

namespace tunica::run {

namespace {

/// What begins now, with the history of a run that goes on taken over. On rank 0.
output::Leg next_leg(RunOutput& output, const std::string& case_file) {
  const std::string& folder = output.folder.path();
  const std::vector<output::Leg> history = history_of(folder);
  if (!output.restart || history.empty()) {
    remove_parameters(folder, history, case_file);
    const std::string name = name_for_parameters(folder, case_file);
    return {output.steps_done(), "", 1, name.empty() ? name_for_changed(folder, "case.xml") : name};
  }
  output.record.take_over(history);
  output::Leg leg{output.steps_done()};
  for (const params::Difference& change : output.restart->changes)
    leg.changes.push_back({change.path, change.before, change.after});
  leg.parameters = leg.changes.empty() ? output::leg_of_step(history, leg.after_step).parameters
                                       : name_for_changed(folder, history.front().parameters);
  return leg;
}

}  // namespace

void enter(const std::string& folder, const setup::CommandLine& command, const Comm& comm,
           io::FolderLock& lock) {
  lock_results_folder(lock, folder, comm);
  check_results_folder(folder, command, command.program, comm);
}

RunOutput::RunOutput(const setup::CommandLine& command, const setup::Case& the_case,
                     const CommPtr& comm, io::FolderLock& lock, std::optional<Restart> from,
                     const Stopwatch& started)
    : folder(the_case.output.folder, comm),
      record(folder.file("run.json"), command.program, TUNICA_VERSION, comm),
      settings(the_case.output), restart(std::move(from)),
      parameters(params::to_xml(the_case.list)), since_start(started) {
  enter(folder.path(), command, *comm, lock);  // again, for it may be new
  record.set("case", "file", command.case_file);
  on_root_or_fault(*comm, [&] {
    const output::Leg leg = next_leg(*this, command.case_file);
    record.begin_leg(leg);
    const std::string path = folder.file(leg.parameters);
    const bool is_kept = restart && std::filesystem::exists(path);
    return is_kept ? Outcome::success() : io::replace_file(path, parameters);
  });
}

RunOutput::RunOutput(const setup::CommandLine& command, const setup::Case& the_case,
                     const Domain& domain, io::FolderLock& lock, std::optional<Restart> from,
                     const Stopwatch& started)
    : RunOutput(command, the_case, domain.comm, lock, std::move(from), started) {
  fingerprint = domain.fingerprint;
  on_root(*domain.comm, [&] { files = hashes_of_files(the_case.list); });
}

}  // namespace tunica::run
