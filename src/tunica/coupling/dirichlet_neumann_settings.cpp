#include "tunica/coupling/dirichlet_neumann.hpp"

namespace tunica::coupling {

params::Table dirichlet_neumann_table() {
  params::Table table(
      "Partitioned coupling: mesh motion, fluid and wall in turn, until they agree.");
  table
      .number("tolerance", 1e-8, params::positive(), "mm",
              "stop at |r|/sqrt(n) below this, r the interface residual, n its vertices")
      .integer("max iterations", 100, params::between(1, 1e5), "cap on the coupling iterations")
      .integer("predictor order", 1, params::between(0, 2),
               "first guess of a step: 0 the last displacement, 1 linear and 2 quadratic "
               "extrapolation in time")
      .number("largest update", 0.0, params::non_negative(), "mm",
              "scale an update of the interface down if a component exceeds this; 0: never")
      .integer("halvings", 5, params::between(0, 50),
               "how often in a row an update is halved if a field fails; each attempt counts as an "
               "iteration; 0: the step fails at once");
  add_acceptance_key(table);
  params::Table added_mass(
      "added-mass preconditioner: one pressure Poisson solve per coupling iteration; the wall "
      "compliance is estimated automatically");
  added_mass.sublist("Added Mass Solver", linear::scalar_solver_table());
  table.variant("preconditioner", "added mass",
                {{"added mass", added_mass}, {"none", params::Table("as in the paper")}},
                "preconditioner of the interface residual, applied before the accelerator; without "
                "it first factors of 0.05 to 0.2 are appropriate");
  add_accelerator_keys(table);
  return table;
}

DirichletNeumannSettings::DirichletNeumannSettings(const Teuchos::ParameterList& of_case)
    : max_iterations(of_case.get<int>("max iterations")),
      tolerance(of_case.get<double>("tolerance")),
      predictor_order(of_case.get<int>("predictor order")),
      largest_update(of_case.get<double>("largest update")), halvings(of_case.get<int>("halvings")),
      accepts_unconverged(coupling::accepts_unconverged(of_case)),
      accelerator(of_case.get<std::string>("accelerator")), list(of_case) {
  if (of_case.get<std::string>("preconditioner") == "added mass")
    added_mass = of_case.sublist("Added Mass Solver");
}

}  // namespace tunica::coupling
