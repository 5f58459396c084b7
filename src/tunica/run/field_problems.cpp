#include "tunica/run/field_problems.hpp"

#include "tunica/coupling/registry.hpp"
#include "tunica/run/initial_state.hpp"
#include "tunica/run/prestress.hpp"

namespace tunica::run {

FieldProblems::FieldProblems(const setup::Case& what, const Domain& of_case)
    : the_case(what), domain(&of_case) {
  if (the_case.fluid)
    fluid = std::make_unique<problems::FluidProblem>(*the_case.fluid, domain->mesh("fluid"));
  if (the_case.wall)
    wall = std::make_unique<problems::SolidProblem>(*the_case.wall, domain->mesh("wall"));
  // Wrong names in the lists of a solver are told before anything is solved.
  if (fluid && !wall) fluid->linear_solver();
  if (wall && !fluid) wall->linear_solver();
}

Outcome FieldProblems::start(RunOutput& output) {
  if (wall) {
    const Outcome stressed = take_prestress(*the_case.wall, output, *wall, fluid.get());
    if (stressed.is_failure() || !output.stopped.empty()) return stressed;
  }
  const bool begins_elsewhere = the_case.time->from && !output.restart;
  if (!fluid || !wall)
    return begins_elsewhere ? take_initial_state(*the_case.time->from, *this) : Outcome::success();
  motion = std::make_unique<problems::MeshMotion>(
      *the_case.motion, domain->mesh("fluid"), domain->interface_surfaces,
      fluid->field().staying_surfaces(), fluid->time_scheme());
  // Before the scheme, whose guesses begin with the states of the fields.
  if (begins_elsewhere) {
    const Outcome begun = take_initial_state(*the_case.time->from, *this);
    if (begun.is_failure()) return begun;
  }
  scheme = coupling::make_scheme(*the_case.coupling, {*domain->interface, *fluid, *wall, *motion,
                                                      domain->common ? &*domain->common : nullptr});
  return Outcome::success();
}

}  // namespace tunica::run
