// One case twice, with walls of different stiffness, in one program: how far does each wall move?
//
//   mpirun -n 2 build/fsi pulse-tiny.xml results

#include <cstdio>
#include <memory>
#include <tunica/base/error.hpp>
#include <tunica/base/session.hpp>
#include <tunica/io/messages.hpp>
#include <tunica/run/simulation.hpp>
#include <tunica/setup/case.hpp>
#include <tunica/setup/schema.hpp>

namespace {

using namespace tunica;

/// A case as the command line of tunica-fsi would have it, with all that a simulation needs.
struct Vessel {
  Vessel(const setup::CommandLine& asked, const CommPtr& comm)
      : command(asked), the_case(setup::read_case(command, setup::fsi_table(), *comm)),
        domain(run::load_domain(the_case, comm)), output(command, the_case.list, domain, lock),
        simulation(the_case, domain, output) {}

  setup::CommandLine command;
  setup::Case the_case;
  run::Domain domain;
  io::FolderLock lock;  ///< keeps others out of the folder of the results
  run::RunOutput output;
  run::Simulation simulation;
};

setup::CommandLine command_for(const std::string& file, const std::string& folder, double c10) {
  setup::CommandLine command{};
  command.program = "fsi";
  command.case_file = file;
  command.output = folder + "/c10-" + std::to_string(static_cast<int>(c10));
  command.overwrite = true;
  for (const char* layer : {"media", "adventitia"})
    command.set.push_back("Wall/Layers/" + std::string(layer) + "/c10=" + std::to_string(c10));
  return command;
}

/// A column of steps.csv after the last step.
double value(const run::Simulation& simulation, const std::string& column) {
  for (const auto& observed : simulation.observed())
    if (observed.name == column) return observed.value;
  throw Error("there is no column \"" + column + "\"");
}

Outcome run_side_by_side(const std::string& file, const std::string& folder, const CommPtr& comm) {
  Vessel soft(command_for(file, folder, 100.0), comm),
      stiff(command_for(file, folder, 300.0), comm);
  Outcome outcome = soft.simulation.begin();
  if (outcome.is_success()) outcome = stiff.simulation.begin();
  while (outcome.is_success() && !soft.simulation.is_done()) {
    outcome = soft.simulation.step();
    if (outcome.is_success()) outcome = stiff.simulation.step();
    if (outcome.is_failure()) break;
    if (comm->getRank() == 0)
      std::printf("t %g ms: %.4f and %.4f mm\n", soft.simulation.time(),
                  value(soft.simulation, "max_displacement_wall_mm"),
                  value(stiff.simulation, "max_displacement_wall_mm"));
  }
  if (outcome.is_success()) outcome = soft.simulation.finish();
  return outcome.is_success() ? stiff.simulation.finish() : outcome;
}

}  // namespace

int main(int argc, char** argv) {
  const Session session;  // MPI and Kokkos, unless they have begun
  if (argc != 3) return std::fprintf(stderr, "usage: fsi CASE.xml FOLDER\n"), 1;
  // What the library says of each step is not of interest here; warnings are.
  io::redirect_messages({[](const std::string&) {}, {}});
  try {
    const Outcome outcome = run_side_by_side(argv[1], argv[2], all_ranks());
    if (outcome.is_failure()) std::fprintf(stderr, "fsi: %s\n", outcome.reason().c_str());
    return outcome.is_success() ? 0 : 2;
  } catch (const Error& error) {
    std::fprintf(stderr, "fsi: %s\n", error.what());
    return 1;
  }
}
