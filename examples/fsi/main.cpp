// A fluid-structure interaction run with a wall law and a load of one's own.
//
//   mpirun -n 2 build/fsi case.xml results
//   "Mesh/file=/where/tunica/is/share/tunica/meshes/tube-tiny.h5"

#include <cstdio>
#include <tunica/base/error.hpp>
#include <tunica/base/session.hpp>
#include <tunica/io/messages.hpp>
#include <tunica/run/simulation.hpp>
#include <tunica/setup/case.hpp>
#include <tunica/setup/schema.hpp>

#include "demiray.hpp"
#include "squeeze.hpp"

namespace {

using namespace tunica;

/// What the command line of tunica-fsi would say. settings: "List/key=value".
setup::CommandLine command_for(const std::string& file, const std::string& folder,
                               const std::vector<std::string>& settings) {
  setup::CommandLine command{};
  command.program = "fsi";
  command.case_file = file;
  command.output = folder;
  command.overwrite = true;
  command.set = settings;
  return command;
}

/// A column of steps.csv after the last step.
double value(const run::Simulation& simulation, const std::string& column) {
  for (const auto& observed : simulation.observed())
    if (observed.name == column) return observed.value;
  throw Error("there is no column \"" + column + "\"");
}

Outcome march(const setup::CommandLine& command, const CommPtr& comm) {
  // 1. The case, its mesh with what belongs to this rank, and the folder of the results.
  const setup::Case the_case = setup::read_case(command, setup::fsi_table(), *comm);
  const run::Domain domain = run::load_domain(the_case, comm);
  io::FolderLock lock;  // keeps other runs out of the folder
  run::RunOutput output(command, the_case, domain, lock);

  // 2. The fields and what couples them.
  run::Simulation simulation(the_case, domain, output);
  Outcome outcome = simulation.begin();

  // 3. Time: each step enters the tables of the run, and here the probe is printed.
  while (outcome.is_success() && !simulation.is_done()) {
    outcome = simulation.step();
    if (outcome.is_failure()) break;
    const double moved =
        value(simulation, "radial_displacement_middle_mm");  // the same on all ranks
    if (comm->getRank() == 0) std::printf("t %g ms: %.4f mm\n", simulation.time(), moved);
  }
  return outcome.is_success() ? simulation.finish() : outcome;
}

}  // namespace

int main(int argc, char** argv) {
  const Session session;  // MPI and Kokkos, unless they have begun
  if (argc < 3) return std::fprintf(stderr, "usage: fsi CASE.xml FOLDER [KEY=VALUE ...]\n"), 1;
  const bool is_root = all_ranks()->getRank() == 0;
  // The library's line for each step is not of interest here; warnings are.
  io::redirect_messages({[](const std::string&) {}, {}});
  try {
    materials::register_law(example::demiray());
    boundary::register_condition(example::squeeze());
    const Outcome outcome =
        march(command_for(argv[1], argv[2], {argv + 3, argv + argc}), all_ranks());
    if (outcome.is_failure() && is_root)
      std::fprintf(stderr, "fsi: %s\n", outcome.reason().c_str());
    return outcome.is_success() ? 0 : 2;
  } catch (const Error& error) {  // on all ranks alike
    if (is_root) std::fprintf(stderr, "fsi: %s\n", error.what());
    return 1;
  }
}
