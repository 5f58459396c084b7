#include "tunica/coupling/monolithic.hpp"

#include <sstream>

#include "tunica/base/timer.hpp"

namespace tunica::coupling {

params::Table monolithic_solver_table() {
  return linear::linear_solver_table(
      {"multigrid", linear::default_block_preconditioner(6, 2), multigrid::mixed_cycle_list(2)});
}

params::Table monolithic_table() {
  const auto reduction = params::Range{0.0, 1.0, true, true};
  params::Table fixed, quasi, newton;
  quasi.number("mesh tolerance", 1e-8, reduction, "1",
               "reduction of the residual where the mesh follows the wall in a Newton step");
  newton = quasi;
  newton.number("product tolerance", 1e-3, reduction, "1",
                "the same where a product with the Jacobian moves the mesh");
  params::Table table("One Newton's method for fluid and wall together.");
  table
      .variant("geometry", "quasi", {{"newton", newton}, {"quasi", quasi}, {"extrapolated", fixed}},
               "how the fluid's domain follows the wall: in each Newton step, with a Jacobian that "
               "knows (newton) or does not (quasi); or extrapolated from earlier steps to the "
               "order of the time scheme, and moved once the step is solved")
      .integer("predictor order", 1, params::between(0, 2),
               "first guess of a step: 0 the last state, 1 linear and 2 quadratic extrapolation in "
               "time")
      .choice("when not converged", "stop", {"stop", "accept"},
              "stop with exit status 2, or accept the step with a warning, go on, and end with 4")
      .sublist("Newton", nonlinear::newton_table({0.0, 1e-9, "mm", "remaining error", 0.03, 2.0}))
      .sublist("Linear Solver", monolithic_solver_table());
  return table;
}

Monolithic::Monolithic(const Teuchos::ParameterList& list,
                       const problems::CoupledProblem::Parts& parts)
    : problem_(list, parts),
      accepts_unconverged_(list.get<std::string>("when not converged") == "accept"),
      fluid_(&parts.fluid), wall_(&parts.wall),
      fluid_states_(parts.fluid, list.get<int>("predictor order")),
      wall_states_(parts.wall, list.get<int>("predictor order")) {}

Outcome Monolithic::find_state(const stepping::Clock& clock, Iteration& iteration,
                               bool& is_converged) {
  if (const Outcome begun = problem_.begin_step(clock); begun.is_failure()) return begun;
  problems::CoupledProblem::Solution found =
      problem_.solve(fluid_states_.extrapolated(clock.step_sizes()),
                     wall_states_.extrapolated(clock.step_sizes()), accepts_unconverged_);
  if (!found.is_taken && found.newton.steps.empty())  // the guess is no state at all
    found = problem_.solve(fluid_->state(), wall_->state(), accepts_unconverged_);
  if (!found.newton.steps.empty()) iteration.residual = found.newton.steps.back().increment;
  iteration.solve("system") = found.newton;
  is_converged = found.newton.is_converged;
  return found.is_taken ? problem_.accept() : Outcome::failure(found.newton.reason);
}

Report Monolithic::solve_step(const stepping::Clock& clock, const Watch& watch) {
  const Stopwatch all;
  Report report;
  Iteration& iteration = report.iterations.emplace_back(new_iteration());
  bool is_converged = false;
  const Outcome found = find_state(clock, iteration, is_converged);
  report.is_accepted = found.is_success();
  report.is_converged = report.is_accepted && is_converged;
  if (report.is_accepted) {
    fluid_states_.accept();
    wall_states_.accept();
  }
  if (!report.is_converged) {
    std::ostringstream text;
    text << "time " << clock.time() << " ms: Newton's method of the whole: "
         << (found.is_failure() ? found.reason() : iteration.solve("system").reason);
    report.reason = text.str();
  }
  const problems::CoupledProblem::Seconds& seconds = problem_.seconds();
  iteration.seconds("motion") = seconds.motion;
  iteration.seconds("fluid") = seconds.fluid;
  iteration.seconds("wall") = seconds.wall;
  iteration.seconds("gather") = seconds.gather;
  iteration.seconds("system") =
      all.seconds() - seconds.motion - seconds.fluid - seconds.wall - seconds.gather;
  watch(1, iteration);
  return report;
}

}  // namespace tunica::coupling
