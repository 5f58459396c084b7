#include "tunica/problems/fluid_problem.hpp"

#include "tunica/io/progress.hpp"

namespace tunica::problems {

FluidSettings::FluidSettings(const Teuchos::ParameterList& list)
    : options(discretisation::fluid_options(list)), solves(list) {}

FluidProblem::FluidProblem(const FluidSettings& settings, const fields::FieldMesh& mesh)
    : ProblemOf(std::make_unique<discretisation::Fluid>(settings.options, mesh), settings.solves) {}

nonlinear::NewtonReport FluidProblem::solve() {
  const io::ProgressScope scope("fluid");
  prepare();
  const nonlinear::NewtonReport report = find_state();
  // While Newton's method runs a closed fluid has its pressure held at a node, in place of the
  // mean.
  if (report.is_converged) field().fix_pressure_level(x_);
  return report;
}

void FluidProblem::set_initial_velocity(const std::function<Vec3(const Vec3& x)>& u) {
  std::vector<Vec3> values(mesh().n_nodes());
  for (int a = 0; a < mesh().n_nodes(); ++a) values[a] = u(mesh().x[a]);
  fields::store(values, mesh(), x_["velocity"]);
  field().start_from(x_);
}

void FluidProblem::set_initial_pressure(double p) { x_["pressure"].putScalar(p); }

params::Table fluid_solver_table() {
  linear::SolverDefaults defaults{"multigrid"};
  defaults.fallbacks = linear::usual_fallbacks();
  return linear::linear_solver_table(defaults);
}

params::Table fluid_table() {
  params::Table table("The fluid: ALE Navier-Stokes, P1-P1 with SUPG and PSPG.");
  discretisation::add_fluid_keys(table);
  table.sublist("Newton", nonlinear::newton_table()).sublist("Linear Solver", fluid_solver_table());
  return table;
}

}  // namespace tunica::problems
