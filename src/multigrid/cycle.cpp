#include "multigrid/cycle.hpp"

#include <MueLu_Hierarchy.hpp>
#include <MueLu_ParameterListInterpreter.hpp>
#include <MueLu_TpetraOperator.hpp>
#include <Teuchos_DefaultSerialComm.hpp>

#include "base/error.hpp"
#include "multigrid/factory_factory.hpp"
#include "multigrid/xpetra.hpp"
#include "params/nearest.hpp"

namespace tunica::multigrid {

using Interpreter = MueLu::ParameterListInterpreter<Scalar, LocalOrdinal, GlobalOrdinal, Node>;

Teuchos::RCP<Operator> make_cycle(const Teuchos::RCP<CrsMatrix>& A,
                                  const Teuchos::RCP<MixedCoarsening>& coarsening,
                                  const Teuchos::ParameterList& muelu) {
  Teuchos::ParameterList list(muelu);
  Interpreter interpreter(list, A->getComm(), make_factory_factory(coarsening));
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

Levels levels_of(const Operator& cycle) {
  using Cycle = MueLu::TpetraOperator<Scalar, LocalOrdinal, GlobalOrdinal, Node>;
  const auto hierarchy = dynamic_cast<const Cycle&>(cycle).GetHierarchy();
  Levels levels;
  double finest = 0.0, all = 0.0;
  for (int l = 0; l < hierarchy->GetNumLevels(); ++l) {
    const auto A = hierarchy->GetLevel(l)->Get<Teuchos::RCP<XMatrix>>("A");
    levels.unknowns.push_back(static_cast<long long>(A->getGlobalNumRows()));
    all += static_cast<double>(A->getGlobalNumEntries());
    if (l == 0) finest = all;
  }
  levels.operator_complexity = all / finest;
  return levels;
}

void check_cycle_list(const Teuchos::ParameterList& muelu) {
  Teuchos::ParameterList list(muelu);
  TUNICA_CHECK(list.isSublist("Hierarchy") && list.isSublist("Factories"),
               "the list lacks \"Factories\" or \"Hierarchy\"; a mixed matrix needs a MueLu list "
               "in the form of factories.");
  std::string cause;
  try {
    const Interpreter interpreter(list, Teuchos::rcp(new Teuchos::SerialComm<int>),
                                  make_factory_factory(Teuchos::null));
  } catch (const std::exception& error) {
    cause = error.what();
  }
  const auto found = cause.find("unknown factory name : ");
  if (found != std::string::npos)
    cause = cause.substr(found, cause.find('\n', found) - found) + ". Ours are " +
            params::quoted(our_factories()) + ", the others are those of MueLu's user's guide.";
  TUNICA_CHECK(cause.empty(), cause);
}

namespace {

/// The levels of the nodal coarsening with a smoother named "Sweeps".
Teuchos::ParameterList nodal_levels(const Teuchos::ParameterList& sweeps, int coarse_size) {
  Teuchos::ParameterList list("MueLu");
  Teuchos::ParameterList& factories = list.sublist("Factories");
  factories.sublist("Nodes").set("factory", "NodalPFactory");
  factories.sublist("Transpose").set("factory", "TransPFactory").set("P", "Nodes");
  factories.sublist("Galerkin")
      .set("factory", "RAPFactory")
      .set("P", "Nodes")
      .set("R", "Transpose");
  factories.sublist("Sweeps") = sweeps;
  // Its default solver is the same, but MueLu then says so on the screen at each set-up.
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

}  // namespace

Teuchos::ParameterList nodal_cycle_list(int sweeps, int coarse_size) {
  Teuchos::ParameterList smoother;
  smoother.set("factory", "TrilinosSmoother").set("type", "RELAXATION");
  smoother.sublist("ParameterList")
      .set("relaxation: type", "Symmetric Gauss-Seidel")
      .set("relaxation: sweeps", sweeps);
  return nodal_levels(smoother, coarse_size);
}

Teuchos::ParameterList mixed_cycle_list() {
  Teuchos::ParameterList smoother;
  smoother.set("factory", "TrilinosSmoother").set("type", "RILUK");
  smoother.sublist("ParameterList").set("fact: iluk level-of-fill", 0);
  return nodal_levels(smoother, 1500);
}

}  // namespace tunica::multigrid
