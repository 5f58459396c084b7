#include "tunica/coupling/dirichlet_neumann.hpp"

#include <algorithm>
#include <cmath>
#include <sstream>

#include "tunica/base/error.hpp"
#include "tunica/base/fault_point.hpp"
#include "tunica/base/formatted.hpp"
#include "tunica/base/reduce.hpp"
#include "tunica/base/timer.hpp"
#include "tunica/base/told_apart.hpp"
#include "tunica/boundary/surface_geometry.hpp"

namespace tunica::coupling {

namespace {

/// The rows of an InterfaceVector.
fields::Places on_interface(const fields::InterfaceTransfer& interface,
                            const fields::FieldMesh& fluid) {
  std::vector<GlobalOrdinal> vertices;
  for (const int a : interface.fluid_nodes) vertices.push_back(fluid.vertex[a]);
  return fields::Places::of_this_rank(std::move(vertices), fluid.comm);
}

}  // namespace

DirichletNeumann::DirichletNeumann(const DirichletNeumannSettings& settings,
                                   const fields::InterfaceTransfer& interface,
                                   problems::FluidProblem& fluid, problems::SolidProblem& wall,
                                   problems::MeshMotion& motion)
    : options_(settings), interface_(&interface), fluid_(&fluid), wall_(&wall), motion_(&motion),
      accelerator_(make_accelerator(settings.list, wall.mesh().comm)),
      displacements_(on_interface(interface, fluid.mesh()), 3, {}, 3) {
  fluid.linear_solver();  // wrong names in its lists are told before anything is solved
  wall.linear_solver();
  displacements_.start_from(wall_displacement());
}

Outcome DirichletNeumann::begin(const stepping::Clock& clock) {
  fluid_->begin_step(clock);
  wall_->begin_step(clock);
  return options_.added_mass ? set_preconditioner(clock) : Outcome::success();
}

Outcome DirichletNeumann::set_preconditioner(const stepping::Clock& clock) {
  const fields::FieldMesh& mesh = fluid_->mesh();
  // ρ (u − ũ)/Δt with u = (d − d̃)/Δt on the interface
  const double mass = fluid_->field().density() * std::pow(fluid_->time_scheme().rate(), 2);
  AddedMassModel model{mesh.x, {}, fluid_->field().open_surfaces(), mass, {}};
  for (int a = 0; a < mesh.n_nodes(); ++a) model.positions[a] += motion_->old_displacement()[a];
  model.area = boundary::nodal_areas(mesh, model.positions, interface_->surfaces);
  // c = n·d under p = 1, the wall linearised where the step begins
  const auto compliance = wall_compliance(*interface_, model.area, *wall_);
  std::ostringstream where;
  where << "time " << clock.time() << " ms: the wall under unit pressure, for the coupling's "
        << "preconditioner";
  // P may be rough: the compliance of an earlier step is better than none.
  if (compliance.is_success()) compliance_ = compliance.value();
  if (!compliance_) return compliance.outcome().at(where.str());
  if (compliance.is_failure() && !has_told_compliance_) {
    remark_ = compliance.outcome().at(where.str()).reason() +
              "; the compliance of an earlier step is used instead, now and later";
    has_told_compliance_ = true;
  }
  model.compliance = *compliance_;
  preconditioner_ = std::make_unique<AddedMass>(*options_.added_mass, mesh, fluid_->scalar_graph(),
                                                *interface_, model);
  accelerator_->set_preconditioner(
      [this](const InterfaceVector& r) { return preconditioner_->apply(r); });
  return Outcome::success();
}

void DirichletNeumann::watch_newton(const NewtonWatch& watch) {
  fluid_->watch_newton([watch](const nonlinear::NewtonStep& step) { watch("fluid", step); });
  wall_->watch_newton([watch](const nonlinear::NewtonStep& step) { watch("wall", step); });
}

InterfaceVector DirichletNeumann::wall_displacement() const {
  return interface_->from_wall(wall_->displacement());
}

// One step of the fixed point d = S(F(d)) on the interface:
//
//   d⁰ = Σ_k c_k dⁿ⁻ᵏ                            predict()
//   F(d): mesh d_f = E d, fluid on it with u = (d − d̃)/Δt_e, its reaction f     move_and_flow()
//   S(f): the wall under f;   r = S(F(d)) − d    evaluate()
//   d ← d + A(r), A of the accelerator; stop where |r| is small                update()
//
//   d   displacement of the interface    mm      f   nodal force of the fluid on the wall    mN
//   E   extension into the fluid's mesh          r   residual of the interface               mm

/// d⁰ = Σ_k c_k dⁿ⁻ᵏ, the polynomial through the last steps.
InterfaceVector DirichletNeumann::predict(const stepping::Clock& clock) const {
  return displacements_.extrapolated(options_.predictor_order, clock.step_sizes());
}

Outcome DirichletNeumann::move_and_flow(const InterfaceVector& d, Iteration& iteration) {
  // d_f = E d
  const Stopwatch moving;
  const Outcome moved = motion_->extend(interface_->to_fluid(d));
  iteration.seconds("motion") = moving.seconds();
  if (moved.is_failure()) return moved.at("the mesh motion");
  // F_f(u, p; d_f) = 0, u = (d − d̃)/Δt_e on the interface
  const Stopwatch flowing;
  const Outcome placed =
      fluid_->field().set_domain(motion_->displacement(), motion_->past_displacement());
  if (placed.is_failure()) return placed.at("the fluid's mesh");
  nonlinear::NewtonReport& report = iteration.solve("fluid");
  report = fluid_->solve();
  iteration.seconds("fluid") = flowing.seconds();
  if (report.is_converged) return Outcome::success();
  return Outcome::failure("the fluid's Newton method: " + report.reason);
}

Outcome DirichletNeumann::evaluate(const InterfaceVector& d, Iteration& iteration,
                                   InterfaceVector& answer) {
  if (const Outcome flow = move_and_flow(d, iteration); flow.is_failure()) return flow;
  // F_s(d, p) = f with f = −R_u of the fluid
  const Stopwatch watch;
  wall_->field().set_nodal_force(interface_->to_wall(interface_->from_fluid(fluid_->reaction())));
  nonlinear::NewtonReport& report = iteration.solve("wall");
  report = wall_->solve();
  iteration.seconds("wall") = watch.seconds();
  answer = wall_displacement();
  if (report.is_converged) return Outcome::success();
  return Outcome::failure("the wall's Newton method: " + report.reason);
}

// |r| = (Σ_k |r_k|²/n)^(1/2) over the nodes of the interface
double DirichletNeumann::size_of(const InterfaceVector& residual) const {
  const double square = inner_product(*wall_->mesh().comm, residual, residual);
  return std::sqrt(square / static_cast<double>(interface_->n_total()));
}

// d + min(1, m/max_i |next_i − d_i|) (next − d), m the largest update
InterfaceVector DirichletNeumann::limited(const InterfaceVector& d, InterfaceVector next) const {
  if (options_.largest_update == 0.0) return next;
  double largest = 0.0;
  for (std::size_t i = 0; i < d.size(); ++i) largest = std::max(largest, std::abs(next[i] - d[i]));
  largest = global_max(*wall_->mesh().comm, largest);
  if (largest > options_.largest_update)
    for (std::size_t i = 0; i < d.size(); ++i)
      next[i] = d[i] + options_.largest_update / largest * (next[i] - d[i]);
  return next;
}

void DirichletNeumann::accept() {
  fluid_->end_step();
  wall_->end_step();
  motion_->end_step();
  accelerator_->end_step();
  displacements_.push(wall_displacement());
}

fields::State DirichletNeumann::save() const {
  fields::State state = on_interface(*interface_, fluid_->mesh()).state();
  displacements_.save_past("displacement ", state);
  state.texts["scheme"] = scheme_name;
  state.texts["accelerator"] = options_.accelerator;
  if (compliance_) state.arrays["compliance"] = {1, *compliance_};
  accelerator_->save(state);
  return state;
}

std::string DirichletNeumann::restore(const fields::State& state) {
  displacements_.restore_past("displacement ", state, wall_displacement());
  compliance_.reset();
  if (state.has_array("compliance")) compliance_ = state.array("compliance", 1).values;
  const std::string& kind = state.text("accelerator");
  if (kind == options_.accelerator) {
    accelerator_->restore(state);
    return "";
  }
  return "the accelerator was \"" + kind + "\" and is \"" + options_.accelerator +
         "\" now: it begins without history";
}

bool DirichletNeumann::update(InterfaceVector& d, const InterfaceVector& answer,
                              Iteration& iteration) {
  const InterfaceVector residual = difference(answer, d);  // r = S(F(d)) − d
  iteration.residual = size_of(residual);
  if (iteration.residual < options_.tolerance) return true;
  const Stopwatch watch;
  fault_point("coupling update");
  d = limited(d, accelerator_->next(d, residual));
  iteration.seconds("update") = watch.seconds();
  iteration.relaxation = accelerator_->relaxation();
  iteration.columns = accelerator_->columns();
  return false;
}

// d ← (d + d_reached)/2 where the fields could not be solved at d
bool DirichletNeumann::go_back(InterfaceVector& d, const InterfaceVector& reached,
                               int n_failed) const {
  if (n_failed > options_.halvings || size_of(difference(d, reached)) == 0.0) return false;
  for (std::size_t i = 0; i < d.size(); ++i) d[i] = 0.5 * (reached[i] + d[i]);
  return true;
}

std::string DirichletNeumann::why_unconverged(double time, const Report& report) const {
  const auto [left, most] = told_apart(report.iterations.back().residual, options_.tolerance);
  return formatted("time %g ms: the interface residual is ", time) + left + " mm after " +
         std::to_string(report.iterations.size()) + " coupling iterations, expected less than " +
         most + " mm";
}

std::string DirichletNeumann::remark_on(double time) {
  std::string remark;
  remark.swap(remark_);
  if (!preconditioner_ || !preconditioner_->has_failed() || has_told_relaxation_) return remark;
  has_told_relaxation_ = true;
  std::ostringstream text;
  text << remark << (remark.empty() ? "" : "; ") << "time " << time
       << " ms: the Laplace problem of the coupling's preconditioner could not be solved; "
          "residuals are not preconditioned, here and whenever it fails";
  return text.str();
}

Report DirichletNeumann::solve(const stepping::Clock& clock, const Watch& watch) {
  Report report;
  // The answer of fluid and wall depends on the step; much more on one of another size.
  const stepping::StepSizes& sizes = clock.step_sizes();
  const bool is_of_other_size = sizes.now > 3.0 * sizes.last || 3.0 * sizes.now < sizes.last;
  if (is_of_other_size) accelerator_->forget();
  accelerator_->begin_step();
  InterfaceVector d = predict(clock), answer, reached = displacements_.value();
  int n_failed = 0;  // in a row
  for (int k = 1; k <= options_.max_iterations && !report.is_converged; ++k) {
    Iteration& iteration = report.iterations.emplace_back(new_iteration());
    const Outcome solved = evaluate(d, iteration, answer);  // d̃
    n_failed = solved.is_success() ? 0 : n_failed + 1;
    if (solved.is_success()) {
      reached = d;
      report.is_converged = update(d, answer, iteration);
    }
    watch(k, iteration);
    if (solved.is_failure() && (k == options_.max_iterations || !go_back(d, reached, n_failed))) {
      std::ostringstream where;
      where << "time " << clock.time() << " ms, coupling iteration " << k;
      report.reason = solved.at(where.str()).reason();
      report.remark = remark_on(clock.time());
      return report;
    }
  }
  // A step whose last iteration fails has returned above: here the fields have a solution, though
  // perhaps not an accurate one.
  report.is_accepted = report.is_converged || options_.accepts_unconverged;
  if (!report.is_converged) report.reason = why_unconverged(clock.time(), report);
  report.remark = remark_on(clock.time());
  if (report.is_accepted) accept();
  return report;
}

}  // namespace tunica::coupling
