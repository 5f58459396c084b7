#pragma once
#include <map>
#include <optional>
#include <string>

#include "tunica/base/timer.hpp"
#include "tunica/io/folder_lock.hpp"
#include "tunica/output/run_folder.hpp"
#include "tunica/output/run_record.hpp"
#include "tunica/run/restart.hpp"
#include "tunica/setup/command_line.hpp"

namespace tunica::run {

/// Output of every run besides its tables. Created when the case and the mesh are known to be
/// valid, so that bad input leaves no files.
struct RunOutput {
  /// lock: of the folder, taken if it was there before. Throws Error where another run has begun in
  /// it meanwhile.
  RunOutput(const setup::CommandLine& command, const setup::Case& the_case, const CommPtr& comm,
            io::FolderLock& lock, std::optional<Restart> from = {}, const Stopwatch& started = {});
  /// Output of a case on its domain.
  RunOutput(const setup::CommandLine& command, const setup::Case& the_case, const Domain& domain,
            io::FolderLock& lock, std::optional<Restart> from = {}, const Stopwatch& started = {});

  int steps_done() const { return restart ? restart->head.step : 0; }

  output::RunFolder folder;
  output::RunRecord record;
  setup::OutputSettings settings;
  std::optional<Restart> restart;              ///< from where the run goes on
  std::string parameters;                      ///< the resolved case, XML
  std::string fingerprint{};                   ///< of the mesh
  std::map<std::string, std::string> files{};  ///< see output::CheckpointHead
  int unconverged_steps = 0;                   ///< that were accepted
  int steps_of_traffic = 0;                    ///< behind the first of this program
  Stopwatch since_start;                       ///< of the program
  bool resumes_prestress = false;              ///< from where an earlier run has left its search
  std::string stopped{};  ///< why the run ends before its end; empty if it does not
};

/// Keeps others out of the folder, and looks whether the run may write there. Collective.
void enter(const std::string& folder, const setup::CommandLine& command, const Comm& comm,
           io::FolderLock& lock);

}  // namespace tunica::run
