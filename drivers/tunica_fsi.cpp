// Marches a fluid-structure interaction problem in time.
//
//   tunica-fsi xml/pulse.xml --output results/pulse
//   mpirun -n 2 tunica-fsi xml/pulse-tiny.xml --steps 2 --set "Coupling/accelerator=aitken"

#include "tunica/app/program.hpp"
#include "tunica/run/simulation.hpp"
#include "tunica/setup/schema.hpp"

namespace {

using namespace tunica;

Outcome march(const setup::Case& the_case, const run::Domain& domain, run::RunOutput& output) {
  // 1. The fluid, the wall and the motion of the mesh, and the scheme that couples them.
  run::Simulation simulation(the_case, domain, output);

  // 2. The prestress of the wall, or the checkpoint that the run goes on from.
  Outcome outcome = simulation.begin();

  // 3. Time: each step is solved, enters the tables, and leaves fields and checkpoints.
  while (outcome.is_success() && !simulation.is_done()) outcome = simulation.step();

  // 4. The last files.
  return outcome.is_success() ? simulation.finish() : outcome;
}

}  // namespace

int main(int argc, char** argv) {
  return tunica::app::run_program(
      argc, argv,
      {"tunica-fsi", "Solves a fluid-structure interaction problem.", tunica::setup::fsi_table()},
      march);
}
