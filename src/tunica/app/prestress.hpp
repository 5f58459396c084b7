#pragma once
#include "tunica/app/run.hpp"
#include "tunica/problems/fluid_problem.hpp"
#include "tunica/problems/solid_problem.hpp"

namespace tunica::app {

/// Gives a wall that stands at its start the stress that the case wants it to have in its mesh, and
/// tells of it on the screen and in the record of the run. A run that goes on has it already.
/// list: the resolved "Wall" list; fluid: where there is one, it bears the wall with its pressure.
/// Fails as problems::find_prestress(). Collective.
Outcome take_prestress(const Teuchos::ParameterList& list, RunOutput& output,
                       problems::SolidProblem& wall, problems::FluidProblem* fluid = nullptr);

}  // namespace tunica::app
