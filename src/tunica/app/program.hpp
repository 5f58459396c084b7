#pragma once
#include <functional>
#include <optional>
#include <string>

#include "tunica/params/table.hpp"
#include "tunica/run/domain.hpp"
#include "tunica/run/run_output.hpp"

namespace tunica::app {

/// A program that solves a case.
struct Program {
  std::string name;      ///< "tunica-fsi"
  std::string sentence;  ///< for --help
  params::Table table;   ///< every key of its cases
};

/// The work of a run; a failure is one to converge.
using March = std::function<Outcome(const setup::Case&, const run::Domain&, run::RunOutput&)>;

/// Action of a program for a case with a certain list at the top; such a case has no mesh.
struct Alternative {
  std::string list;
  params::Table table;
  /// Reads what the case names, and returns the work. Collective, both.
  std::function<std::function<Outcome(run::RunOutput&)>(const Teuchos::ParameterList&,
                                                        const CommPtr&)>
      load;
};

/// The frame of every solving driver, guarded: command line, case, mesh, --dry-run, the march.
/// Starts and ends MPI.
int run_program(int argc, char** argv, const Program& program, const March& march,
                const std::optional<Alternative>& alternative = {});

}  // namespace tunica::app
