#pragma once
#include <functional>
#include <map>
#include <optional>
#include <string>

#include "tunica/app/case.hpp"
#include "tunica/app/command_line.hpp"
#include "tunica/app/domain.hpp"
#include "tunica/app/restart.hpp"
#include "tunica/base/outcome.hpp"
#include "tunica/base/timer.hpp"
#include "tunica/io/folder_lock.hpp"
#include "tunica/output/field_writer.hpp"
#include "tunica/output/run_folder.hpp"
#include "tunica/output/run_record.hpp"

namespace tunica::app {

/// A program that solves a case.
struct Program {
  std::string name;      ///< "tunica-fsi"
  std::string sentence;  ///< for --help
  params::Table table;   ///< every key of its cases
};

/// A program as it was called.
struct Call {
  const Program& program;
  const CommandLine& command;
  Stopwatch since_start{};
};

/// What every run writes beside its tables. Made when the case and the mesh are known to be
/// good, so that a bad input leaves nothing behind.
struct RunOutput {
  /// lock: of the folder, taken if it was there before. Throws Error where another run has begun in
  /// it meanwhile.
  RunOutput(const Call& call, const Teuchos::ParameterList& list, const CommPtr& comm,
            io::FolderLock& lock, std::optional<Restart> from = {});

  int steps_done() const { return restart ? restart->head.step : 0; }

  output::RunFolder folder;
  output::RunRecord record;
  int fields_every, checkpoint_every;
  int compression;                             ///< of the fields
  bool has_asked_times;                        ///< the case wants fields at times
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

/// The work of a run; a failure is one to converge.
using March = std::function<Outcome(const Teuchos::ParameterList&, const Domain&, RunOutput&)>;

/// What a program does with a case that has a certain list at the top: such a case has no mesh.
struct Alternative {
  std::string list;
  params::Table table;
  /// Reads what the case names, and returns the work. Collective, both.
  std::function<std::function<Outcome(RunOutput&)>(const Teuchos::ParameterList&, const CommPtr&)>
      load;
};

/// The frame of every solving driver, guarded: command line, case, mesh, --dry-run, the march.
/// Starts and ends MPI.
int run_program(int argc, char** argv, const Program& program, const March& march,
                const std::optional<Alternative>& alternative = {});

}  // namespace tunica::app
