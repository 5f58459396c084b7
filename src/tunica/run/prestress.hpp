#pragma once
#include "tunica/problems/fluid_problem.hpp"
#include "tunica/problems/solid_problem.hpp"
#include "tunica/run/run_output.hpp"

namespace tunica::run {

/// Gives a wall that stands at its start the stress that the case wants it to have in its mesh, and
/// tells of it on the screen, in prestress.csv and in the record of the run. A run that goes on has
/// it already; one that was ended while it searched goes on with its search. A signal to stop ends
/// it between two equilibria: RunOutput::stopped says so. fluid: where
/// there is one, it bears the wall with its pressure.
/// Fails as problems::find_prestress(). Collective.
Outcome take_prestress(const problems::SolidSettings& settings, RunOutput& output,
                       problems::SolidProblem& wall, problems::FluidProblem* fluid = nullptr);

/// Head of the file of an interrupted search in the folder of the case, before the first checkpoint
/// of the run; empty if there is none. Throws Error if it belongs to another mesh. Collective.
std::optional<output::CheckpointHead> begun_prestress(const setup::Case& the_case,
                                                      const Domain& domain);

}  // namespace tunica::run
