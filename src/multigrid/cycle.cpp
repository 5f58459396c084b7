#include "multigrid/cycle.hpp"

#include <MueLu_Hierarchy.hpp>
#include <MueLu_ParameterListInterpreter.hpp>
#include <MueLu_TpetraOperator.hpp>

#include "multigrid/factory_factory.hpp"
#include "multigrid/xpetra.hpp"

namespace tunica::multigrid {

Teuchos::RCP<Operator> make_cycle(const Teuchos::RCP<CrsMatrix>& A,
                                  const Teuchos::RCP<NodalCoarsening>& coarsening,
                                  const Teuchos::ParameterList& muelu) {
  Teuchos::ParameterList list(muelu);
  MueLu::ParameterListInterpreter<Scalar, LocalOrdinal, GlobalOrdinal, Node> interpreter(
      list, A->getComm(), make_factory_factory(coarsening));
  const auto hierarchy = interpreter.CreateHierarchy();
  hierarchy->setlib(Xpetra::UseTpetra);
  hierarchy->GetLevel(0)->Set("A", wrapped(A));
  interpreter.SetupHierarchy(*hierarchy);
  hierarchy->IsPreconditioner(true);
  const Teuchos::RCP<Operator> cycle =
      Teuchos::rcp(new MueLu::TpetraOperator<Scalar, LocalOrdinal, GlobalOrdinal, Node>(hierarchy));
  // MueLu factors the coarsest matrix when it is first needed: a singular one must fail here.
  const MultiVector zero(A->getRangeMap(), 1);
  MultiVector nothing(A->getDomainMap(), 1);
  cycle->apply(zero, nothing);
  return cycle;
}

Teuchos::ParameterList nodal_cycle_list(int sweeps, int coarse_size) {
  Teuchos::ParameterList list("MueLu");
  Teuchos::ParameterList& factories = list.sublist("Factories");
  factories.sublist("Nodes").set("factory", "NodalPFactory");
  factories.sublist("Transpose").set("factory", "TransPFactory").set("P", "Nodes");
  factories.sublist("Galerkin")
      .set("factory", "RAPFactory")
      .set("P", "Nodes")
      .set("R", "Transpose");
  Teuchos::ParameterList& smoother = factories.sublist("Sweeps");
  smoother.set("factory", "TrilinosSmoother").set("type", "RELAXATION");
  smoother.sublist("ParameterList")
      .set("relaxation: type", "Symmetric Gauss-Seidel")
      .set("relaxation: sweeps", sweeps);
  factories.sublist("Coarsest").set("factory", "DirectSolver").set("type", "Klu");
  Teuchos::ParameterList& hierarchy = list.sublist("Hierarchy");
  hierarchy.set("max levels", 10).set("coarse: max size", coarse_size).set("verbosity", "None");
  hierarchy.sublist("All")
      .set("P", "Nodes")
      .set("R", "Transpose")
      .set("A", "Galerkin")
      .set("Smoother", "Sweeps")
      .set("CoarseSolver", "Coarsest");
  return list;
}

}  // namespace tunica::multigrid
