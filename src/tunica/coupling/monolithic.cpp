#include "tunica/coupling/monolithic.hpp"

#include <sstream>

#include "tunica/base/formatted.hpp"
#include "tunica/base/timer.hpp"

namespace tunica::coupling {

// As for the wall, whose stiffness K has: 6 + 6 and 2 + 2 sweeps in block LU, three of Chebyshev's
// in the cycle, whose coarse levels know of rotations where it contracts badly without: in steps in
// which inertia outweighs bending they only cost, a fifth of a step and a seventh of the memory of
// a tube with 350,000 tetrahedra. So do W cycles: on a vessel with 337,000 unknowns, at steps of
// 5 ms, a seventh of a step, for no iteration less. What P misses, as how the domain follows, ten
// recycled directions of GCR keep.
params::Table monolithic_solver_table() {
  return linear::linear_solver_table({"multigrid", linear::default_block_preconditioner(6, 2),
                                      multigrid::mixed_cycle_list(3, "chebyshev", 0.25, false),
                                      true, 10, linear::usual_fallbacks()});
}

// Newton's method stops where 10⁻⁹ mm are left, solves each system to 0.03, and a new Jacobian has
// to save 1.5 steps.
params::Table monolithic_table() {
  const auto reduction = params::Range{0.0, 1.0, true, true};
  params::Table fixed, moving;
  moving
      .number("mesh tolerance", 1e-8, reduction, "1",
              "relative residual to which the mesh follows the wall; within Newton's method it "
              "suffices to reduce the residual that a step causes by the least linear tolerance of "
              "\"Newton\"")
      .number("product tolerance", 1e-2, reduction, "1",
              "relative residual of the mesh motion within a product with the Jacobian; at most "
              "the least linear tolerance of \"Newton\"");
  params::Table table("One Newton's method for fluid and wall together.");
  table
      .variant(
          "geometry", "automatic",
          {{"automatic", moving}, {"newton", moving}, {"quasi", moving}, {"extrapolated", fixed}},
          "how the fluid's domain follows the wall: in each Newton step, with ALE shape "
          "derivatives in the Jacobian (newton), without them, as a quasi-Newton method (quasi), "
          "or with those of the two that pay off, decided at run time (automatic); or extrapolated "
          "from earlier steps at the order of the time scheme, and moved once the step is solved "
          "(extrapolated)")
      .integer("predictor order", 2, params::between(0, 2),
               "first guess of a step: 0 the last state, 1 linear and 2 quadratic extrapolation in "
               "time");
  add_acceptance_key(table);
  table.sublist("Newton", nonlinear::newton_table({0.0, 1e-9, "mm", "remaining error", 0.03, 1.5}))
      .sublist("Linear Solver", monolithic_solver_table());
  return table;
}

MonolithicSettings::MonolithicSettings(const Teuchos::ParameterList& list)
    : problem(list), predictor_order(list.get<int>("predictor order")),
      accepts_unconverged(coupling::accepts_unconverged(list)) {}

Monolithic::Monolithic(const MonolithicSettings& settings,
                       const problems::CoupledProblem::Parts& parts)
    : problem_(settings.problem, parts), accepts_unconverged_(settings.accepts_unconverged),
      predictor_order_(settings.predictor_order), fluid_(&parts.fluid), wall_(&parts.wall),
      motion_(&parts.motion), fluid_states_(parts.fluid, settings.predictor_order),
      wall_states_(parts.wall, settings.predictor_order) {
  if (settings.problem.geometry == problems::DomainRule::automatic) rule_.emplace();
}

// F(x) = 0 of fluid, wall and mesh together, once from x⁰ = Σ_k c_k xⁿ⁻ᵏ and, where that fails,
// once more from xⁿ⁻¹ with care.
Outcome Monolithic::attempt(bool is_careful, const stepping::Clock& clock, Iteration& iteration,
                            bool& is_over) {
  const Stopwatch all;
  const problems::CoupledProblem::Seconds before = problem_.seconds();
  if (rule_)
    problem_.want_shape_derivatives(rule_->wants_derivatives(), GeometryRule::most_without);
  const int degree = is_careful ? 0 : predictor_order_;
  motion_->begin_extrapolated(degree, clock.step_sizes());
  const auto solution =
      is_careful ? problem_.solve_carefully(fluid_->state(), wall_->state(), accepts_unconverged_)
                 : problem_.solve(fluid_states_.extrapolated(clock.step_sizes()),
                                  wall_states_.extrapolated(clock.step_sizes()), false);
  // The careful attempt has derivatives in any case, and teaches nothing about their worth.
  if (rule_ && !is_careful) {
    if (solution.newton.is_converged)
      rule_->note(solution.newton, solution.has_gone_over);
    else if (!solution.newton.steps.empty())
      rule_->note_failure();
    if (!solution.newton.is_converged) failed_step_ = clock.step();
  }
  iteration.solve("system") = solution.newton;
  if (!solution.newton.steps.empty()) iteration.residual = solution.newton.steps.back().increment;
  is_over = solution.is_taken;
  const Outcome outcome =
      solution.is_taken ? problem_.accept() : Outcome::failure(solution.newton.reason);
  const problems::CoupledProblem::Seconds& now = problem_.seconds();
  iteration.seconds("motion") = now.motion - before.motion;
  iteration.seconds("fluid") = now.fluid - before.fluid;
  iteration.seconds("wall") = now.wall - before.wall;
  iteration.seconds("matrix") = now.matrix - before.matrix;
  // What no stage has counted went into linear systems and Newton's method itself.
  double others = 0.0;
  for (const Stage& stage : iteration.stages) others += stage.seconds;
  iteration.seconds("system") = all.seconds() - others;
  return outcome;
}

void Monolithic::watch_newton(const NewtonWatch& watch) {
  problem_.watch_newton([watch](const nonlinear::NewtonStep& step) { watch("system", step); });
}

fields::State Monolithic::save() const {
  const fields::BlockOperator& K = problem_.last_jacobian();
  fields::State state = fields::state_on(K.mesh());
  state.texts["scheme"] = scheme_name;
  problems::save_solver(problem_.present_solver(), K.split(), state);
  if (rule_) rule_->save(state);
  return state;
}

std::string Monolithic::restore(const fields::State& state) {
  const fields::BlockOperator& K = problem_.last_jacobian();
  problems::restore_solver(state, K.space(), K.split(), problem_.linear_solver());
  // A step that is repeated since it failed keeps what the failure has taught.
  if (rule_ && step_ != failed_step_ && state.numbers.count("geometry") > 0) rule_->restore(state);
  return "";
}

Outcome Monolithic::begin(const stepping::Clock& clock) {
  step_ = clock.step();
  return problem_.begin_step(clock).at(formatted("time %g ms", clock.time()));
}

// The careful attempt follows where the first one has found no state. One that was found, and whose
// mesh could not follow, ends the step.
Report Monolithic::solve(const stepping::Clock& clock, const Watch& watch) {
  Report report;
  Outcome outcome = Outcome::success();
  bool is_over = false;
  for (const bool is_careful : {false, true}) {
    if (is_over) break;
    Iteration& iteration = report.iterations.emplace_back(new_iteration());
    outcome = attempt(is_careful, clock, iteration, is_over);
    watch(static_cast<int>(report.iterations.size()), iteration);
  }
  report.is_accepted = outcome.is_success();
  report.is_converged = report.is_accepted && report.iterations.back().solve("system").is_converged;
  if (report.is_accepted) {
    fluid_states_.accept();
    wall_states_.accept();
  }
  if (!report.is_converged) {
    std::ostringstream text;
    text << "time " << clock.time() << " ms: Newton's method of the whole: "
         << (outcome.is_failure() ? outcome.reason()
                                  : report.iterations.back().solve("system").reason);
    report.reason = text.str();
  }
  return report;
}

}  // namespace tunica::coupling
