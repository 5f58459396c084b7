#include "tunica/run/field_problems.hpp"

#include "tunica/coupling/registry.hpp"
#include "tunica/run/prestress.hpp"

namespace tunica::run {

namespace {

/// The "Fluid" list of a resolved case; on the way to a steady flow Newton's method stops earlier.
Teuchos::ParameterList fluid_list(const Teuchos::ParameterList& list) {
  Teuchos::ParameterList fluid(list.sublist("Fluid"));
  const Teuchos::ParameterList& time = list.sublist("Time");
  if (time.get<std::string>("step control") == "steady")
    fluid.sublist("Newton").set("relative increment", time.get<double>("newton increment"));
  return fluid;
}

}  // namespace

FieldProblems::FieldProblems(const Teuchos::ParameterList& the_case, const Domain& of_case)
    : list(the_case), domain(&of_case) {
  if (domain->has("fluid"))
    fluid = std::make_unique<problems::FluidProblem>(fluid_list(list), domain->mesh("fluid"));
  if (domain->has("wall"))
    wall = std::make_unique<problems::SolidProblem>(list.sublist("Wall"), domain->mesh("wall"));
  // Wrong names in the lists of a solver are told before anything is solved.
  if (fluid && !wall) fluid->linear_solver();
  if (wall && !fluid) wall->linear_solver();
}

Outcome FieldProblems::start(RunOutput& output) {
  if (wall) {
    const Outcome stressed = take_prestress(list.sublist("Wall"), output, *wall, fluid.get());
    if (stressed.is_failure() || !output.stopped.empty()) return stressed;
  }
  if (!fluid || !wall) return Outcome::success();
  motion = std::make_unique<problems::MeshMotion>(
      list.sublist("Mesh Motion"), domain->mesh("fluid"), domain->interface_surfaces,
      fluid->field().staying_surfaces(), fluid->time_scheme());
  scheme = coupling::make_scheme(
      list.sublist("Coupling"),
      {*domain->interface, *fluid, *wall, *motion, domain->common ? &*domain->common : nullptr});
  return Outcome::success();
}

}  // namespace tunica::run
