#pragma once
#include <fstream>
#include <optional>
#include <sstream>

#include "tunica/io/messages.hpp"
#include "tunica/run/simulation.hpp"
#include "tunica/setup/case.hpp"
#include "tunica/setup/schema.hpp"
#include "unit/io/scratch.hpp"

namespace tunica::test {

/// Takes what the library says while it lives.
class Quiet {
public:
  Quiet() {
    const auto keep = [this](const std::string& line) { said += line; };
    io::redirect_messages({keep, keep});
  }
  ~Quiet() { io::redirect_messages({}); }

  std::string said;
};

/// A case with all that a simulation of it needs.
struct Whole {
  Whole(const std::string& file, const std::vector<std::string>& set, const std::string& folder,
        const CommPtr& comm, bool goes_on = false)
      : command(command_for(file, set, folder, goes_on)),
        the_case(setup::read_case(command, setup::fsi_table(), *comm)), list(the_case.list),
        domain(run::load_domain(the_case, comm)),
        output(command, the_case, domain, lock,
               goes_on ? std::make_optional(run::find_restart(the_case, domain)) : std::nullopt),
        simulation(the_case, domain, output) {}

  static setup::CommandLine command_for(const std::string& file,
                                        const std::vector<std::string>& set,
                                        const std::string& folder, bool goes_on) {
    setup::CommandLine command{};
    command.program = "tunica-fsi";
    command.case_file = TUNICA_MESHES "/../xml/" + file;
    command.output = folder;
    command.set = set;
    command.restart = goes_on;
    return command;
  }

  setup::CommandLine command;
  setup::Case the_case;
  const Teuchos::ParameterList& list;
  run::Domain domain;
  io::FolderLock lock;
  run::RunOutput output;
  run::Simulation simulation;
};

/// steps.csv without the column of seconds.
inline std::string steps_of(const Whole& run) {
  std::ifstream file(run.output.folder.file("steps.csv"));
  std::string line, text;
  int seconds = -1;
  while (std::getline(file, line)) {
    std::istringstream cells(line);
    std::string cell;
    for (int column = 0; std::getline(cells, cell, ','); ++column) {
      if (cell == "seconds") seconds = column;
      if (column != seconds) text += cell + ",";
    }
    text += "\n";
  }
  return text;
}

}  // namespace tunica::test
