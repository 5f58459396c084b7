#include "tunica/linear/amg.hpp"

#include "tunica/linear/setup_failure.hpp"
#include "tunica/multigrid/muelu/cycle.hpp"

namespace tunica::linear {

namespace {

/// MueLu's smoothed aggregation, but for the smoother and the coarsest level.
Teuchos::ParameterList amg_list() {
  Teuchos::ParameterList list("MueLu");
  Teuchos::ParameterList& factories = list.sublist("Factories");
  // Chebyshev's polynomials need the largest eigenvalue, and where meshes are irregular ten steps
  // of the power method find it 40 % too small: the cycle diverges then.
  Teuchos::ParameterList& sweeps = factories.sublist("Sweeps");
  sweeps.set("factory", "TrilinosSmoother").set("type", "RELAXATION");
  sweeps.sublist("ParameterList").set("relaxation: type", "Symmetric Gauss-Seidel");
  factories.sublist("Coarsest").set("factory", "SparseLUSolver");
  Teuchos::ParameterList& hierarchy = list.sublist("Hierarchy");
  hierarchy.set("max levels", 10).set("coarse: max size", 2000).set("verbosity", "None");
  hierarchy.sublist("All").set("Smoother", "Sweeps").set("CoarseSolver", "Coarsest");
  return list;
}

}  // namespace

Teuchos::RCP<Operator> make_amg(const Teuchos::RCP<CrsMatrix>& matrix) {
  Teuchos::RCP<Operator> cycle;
  set_up(*matrix->getComm(), "a multigrid cycle for one unknown per node",
         [&] { cycle = Teuchos::rcp(new multigrid::Cycle(matrix, Teuchos::null, amg_list())); });
  return cycle;
}

}  // namespace tunica::linear
