// Solves a wall alone, static or dynamic.
//
//   tunica-solid xml/inflation.xml --output results/inflation

#include "tunica/app/program.hpp"
#include "tunica/run/simulation.hpp"
#include "tunica/setup/schema.hpp"

namespace {

using namespace tunica;

Outcome march(const setup::Case& the_case, const run::Domain& domain, run::RunOutput& output) {
  // 1. The wall.
  run::Simulation simulation(the_case, domain, output);

  // 2. Its prestress, or the checkpoint that the run goes on from.
  Outcome outcome = simulation.begin();

  // 3. Time; in statics each step is an equilibrium.
  while (outcome.is_success() && !simulation.is_done()) outcome = simulation.step();

  // 4. The last files.
  return outcome.is_success() ? simulation.finish() : outcome;
}

}  // namespace

int main(int argc, char** argv) {
  return tunica::app::run_program(
      argc, argv, {"tunica-solid", "Solves a wall alone.", tunica::setup::solid_table()}, march);
}
