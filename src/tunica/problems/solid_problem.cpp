#include "tunica/problems/solid_problem.hpp"

#include <algorithm>

#include "tunica/base/error.hpp"
#include "tunica/io/progress.hpp"
#include "tunica/linear/direct/direct_factor.hpp"
#include "tunica/problems/fibre_frames.hpp"
#include "tunica/problems/prestress.hpp"

namespace tunica::problems {

SolidSettings::SolidSettings(const Teuchos::ParameterList& list)
    : options(discretisation::solid_options(list)), solves(list),
      prestress(prestress_options(list.sublist("Prestress"))), frame(list.sublist("Fibre Frame")) {}

std::vector<materials::Frame> frames_of_wall(const SolidSettings& settings,
                                             const fields::FieldMesh& mesh) {
  // Without fibres no directions are needed, nor the surfaces to make them of.
  if (!has_fibres(settings.options)) return {};
  return fibre_frames(settings.frame, mesh);
}

SolidProblem::SolidProblem(const SolidSettings& settings, const fields::FieldMesh& mesh)
    : SolidProblem(settings, mesh, frames_of_wall(settings, mesh)) {}

SolidProblem::SolidProblem(const SolidSettings& settings, const fields::FieldMesh& mesh,
                           std::vector<materials::Frame> frames)
    : ProblemOf(std::make_unique<discretisation::Solid>(settings.options, mesh, std::move(frames)),
                settings.solves) {}

void SolidProblem::start_from(const algebra::BlockVector& x, const Vector& rate) {
  take(x);
  field().start_from(x_, fields::ghosted_vectors(mesh(), rate));
}

nonlinear::NewtonReport SolidProblem::solve() {
  const io::ProgressScope scope("wall");
  // Newton's method begins where all that is prescribed holds: its increments there are zero.
  field().prescribe(x_);
  return field().has_stress_residual() && field().is_static() ? find_equilibrium() : find_state();
}

/// The stress that drives the subscales is renewed until it changes by no more than this.
constexpr double settled = 1e-3;
constexpr int most_passes = 30;

// An equilibrium does not depend on the step before, nor does the stress that drives its subscales:
//
//   F(x; s) = 0,   s = σ'*(x)
//
// Newton's method for x, loosely, then a step of it after each new s, then to its own goal. Where s
// does not settle, or leads Newton's method astray, the equilibrium is that with s = 0.
nonlinear::NewtonReport SolidProblem::find_equilibrium() {
  nonlinear::NewtonOptions options = newton();
  options.stop_at = nonlinear::StopAt::increment;
  options.relative_increment = std::max(1e-2, newton().relative_increment);
  nonlinear::NewtonReport report = find_state(options);
  const auto go_on = [&](double relative_increment, double absolute_increment) {
    options.relative_increment = relative_increment;
    options.absolute_increment = absolute_increment;
    nonlinear::NewtonReport next = find_state(options);
    next.comes_after(report);
    report = std::move(next);
  };
  algebra::BlockVector before(space());
  before.assign(x_);
  bool has_settled = false;
  double least = 1e300;
  for (int pass = 0, grown = 0; report.is_converged && pass < most_passes && grown < 3; ++pass) {
    const double change = field().renew_stress_force(x_);
    has_settled = change < settled;
    if (has_settled) break;
    if (change >= least) ++grown;
    least = std::min(least, change);
    go_on(1.0, newton().absolute_increment);  // one step
  }
  // s = 0 for the rest of the step, from the state before s was renewed
  if (!has_settled) {
    const bool had_any = field().leave_out_stress_force();
    if (!report.is_converged && !had_any) return report;
    io::announce(
        "the recovered stress that drives the wall's subscales does not converge: this step omits "
        "it");
    x_.assign(before);
  }
  const double first = report.steps.empty() ? 0.0 : report.steps.front().increment;
  const double goal = newton().relative_increment * first;
  options.stop_at = newton().stop_at;
  go_on(0.0, std::max(goal, newton().absolute_increment));
  return report;
}

/// Of the linearised wall, which is an estimate: a solver that stops short of its goal is no reason
/// to end a run.
constexpr double usable_residual = 1e-2;

// K x = P f with K at the present state
Result<std::vector<Vec3>> SolidProblem::solve_linearised(const std::vector<Vec3>& force) {
  jacobian(x_);
  algebra::BlockVector b(space()), x(space());
  field().load_of(force, b);
  try {
    const linear::SolveReport report = linear_solver().solve(b, x, 1e-8);
    const bool is_near = report.true_residual < usable_residual;
    if (report.is_converged || is_near) return fields::owned_vectors(mesh(), x["displacement"]);
    return Result<std::vector<Vec3>>::failure(linear::describe_unconverged(report));
  } catch (const linear::SetupFailure& error) {
    return Result<std::vector<Vec3>>::failure(error.what());
  }
}

std::vector<Vec3> SolidProblem::displacement() const {
  return fields::owned_vectors(mesh(), x_["displacement"]);
}

std::vector<Vec3> SolidProblem::velocity() const {
  const std::vector<Vec3>& v = field().velocity();
  return {v.begin(), v.begin() + mesh().n_owned};
}

// More sweeps than for a fluid, as on fine meshes A turns from mass to elasticity: 6 + 6 for Ã and
// 2 + 2 for S̃, three with Chebyshev's weights in the cycle for all of K.
params::Table solid_solver_table() {
  linear::SolverDefaults defaults{"multigrid", linear::default_block_preconditioner(6, 2),
                                  multigrid::mixed_cycle_list(3, "chebyshev")};
  defaults.fallbacks = linear::usual_fallbacks();
  return linear::linear_solver_table(defaults);
}

params::Table solid_table() {
  params::Table table("The wall: mixed displacement-pressure hyperelasticity, P1-P1 with PSPG.");
  discretisation::add_layer_keys(table);
  table.sublist("Fibre Frame", fibre_frame_table());
  discretisation::add_solid_keys(table);
  table.sublist("Prestress", prestress_table());
  table.sublist("Newton", nonlinear::newton_table())
      .sublist("Linear Solver", solid_solver_table())
      .check([](const Teuchos::ParameterList& list, const std::string& path) {
        TUNICA_CHECK(list.sublist("Layers").numParams() > 0,
                     path + " / Layers: no layer. Name each region of the wall.");
        TUNICA_CHECK(list.get<std::string>("stabilisation residual") != "stress" ||
                         list.sublist("Prestress").get<double>("pressure") == 0.0,
                     path +
                         ": \"stabilisation residual\" is \"stress\", and there is a Prestress, "
                         "which is found without it. Set it to \"linear\".");
        if (list.sublist("Fibre Frame").get<std::string>("kind") != "none") return;
        for (const discretisation::Layer& layer : discretisation::solid_options(list).layers)
          TUNICA_CHECK(!law_of(layer)->has_fibres(),
                       path + " / Layers / " + layer.region + ": the law \"" + layer.law +
                           "\" has fibres, but " + path +
                           " / Fibre Frame has no directions for them. Set its \"kind\" to "
                           "\"tube\", \"laplace\" or \"mesh\".");
      });
  return table;
}

}  // namespace tunica::problems
