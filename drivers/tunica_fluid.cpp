// Solves a fluid alone in a rigid domain.
//
//   tunica-fluid xml/poiseuille.xml --output results/poiseuille

#include "tunica/app/program.hpp"
#include "tunica/run/simulation.hpp"
#include "tunica/setup/schema.hpp"

namespace {

using namespace tunica;

Outcome march(const setup::Case& the_case, const run::Domain& domain, run::RunOutput& output) {
  // 1. The fluid.
  run::Simulation simulation(the_case, domain, output);

  // 2. From rest, or from the checkpoint that the run goes on from.
  Outcome outcome = simulation.begin();

  // 3. Time, or pseudo-time to a steady flow.
  while (outcome.is_success() && !simulation.is_done()) outcome = simulation.step();

  // 4. The last files.
  return outcome.is_success() ? simulation.finish() : outcome;
}

}  // namespace

int main(int argc, char** argv) {
  return tunica::app::run_program(
      argc, argv,
      {"tunica-fluid", "Solves a fluid alone in a rigid domain.", tunica::setup::fluid_table()},
      march);
}
