// Solves the flow of examples/smoothers in the two ways that Trilinos' own programs go: through
// Stratimikos, whose list names the solver and the preconditioner, and through a hierarchy that
// MueLu's interpreter makes of its XML, with the factories of Tunica beside its own.
//
//   registered stratimikos.xml
//   mpirun -n 2 registered stratimikos.xml
//
// Exit status: 0 both converged, 1 not.
#include <BelosBlockGmresSolMgr.hpp>
#include <BelosTpetraAdapter.hpp>
#include <MueLu_ParameterListInterpreter.hpp>
#include <MueLu_TpetraOperator.hpp>
#include <Stratimikos_DefaultLinearSolverBuilder.hpp>
#include <Teuchos_AbstractFactoryStd.hpp>
#include <Teuchos_XMLParameterListHelpers.hpp>
#include <Thyra_LinearOpWithSolveFactoryHelpers.hpp>
#include <cstdio>
#include <exception>

#include "../smoothers/stokes.hpp"
#include "cycle_factory.hpp"
#include "tunica/multigrid/coarsening/matrix_coarsening.hpp"
#include "tunica/multigrid/muelu/factory_factory.hpp"

namespace {

// |b − K x| / |b|
double residual(const Stokes& stokes, const MultiVector& x) {
  MultiVector r(*stokes.b, Teuchos::Copy);
  stokes.K->apply(x, r, Teuchos::NO_TRANS, -1.0, 1.0);
  Teuchos::Array<double> of_r(1), of_b(1);
  r.norm2(of_r());
  stokes.b->norm2(of_b());
  return of_r[0] / of_b[0];
}

// The list says all; a second solve with new values refreshes the cycle.
double by_stratimikos(const Stokes& stokes, const Teuchos::RCP<Teuchos::ParameterList>& list) {
  Stratimikos::DefaultLinearSolverBuilder builder;
  builder.setPreconditioningStrategyFactory(
      Teuchos::abstractFactoryStd<Thyra::PreconditionerFactoryBase<double>, CycleFactory>(),
      "Tunica Cycle");
  builder.setParameterList(list);
  const auto factory = builder.createLinearSolveStrategy("");
  const Teuchos::RCP<Operator> as_operator = stokes.K;
  const auto K = Thyra::createConstLinearOp<double>(Teuchos::RCP<const Operator>(as_operator));
  const auto b = Thyra::createConstMultiVector<double>(Teuchos::RCP<const MultiVector>(stokes.b));
  const auto x = Teuchos::rcp(new MultiVector(stokes.map, 1));
  const auto wrapped_x = Thyra::createMultiVector<double>(x);
  const auto solver = factory->createOp();
  double largest = 0.0;
  for (const double factor : {1.0, 2.0}) {
    stokes.K->scale(factor);
    Thyra::initializeOp<double>(*factory, K, solver.ptr());
    x->putScalar(0.0);
    Thyra::solve<double>(*solver, Thyra::NOTRANS, *b, wrapped_x.ptr());
    largest = std::max(largest, residual(stokes, *x));
  }
  stokes.K->scale(0.5);
  return largest;
}

// The same MueLu list for MueLu alone.
double by_muelu(const Stokes& stokes, const Teuchos::ParameterList& of_muelu) {
  using Node = Map::node_type;
  Teuchos::ParameterList list(of_muelu);
  MueLu::ParameterListInterpreter<double, int, long long, Node> interpreter(
      list, stokes.map->getComm(),
      tunica::multigrid::make_factory_factory(tunica::multigrid::make_coarsening(*stokes.K, 3)));
  const auto hierarchy = interpreter.CreateHierarchy();
  hierarchy->setlib(Xpetra::UseTpetra);
  hierarchy->GetLevel(0)->Set(
      "A", MueLu::TpetraCrs_To_XpetraMatrix<double, int, long long, Node>(stokes.K));
  interpreter.SetupHierarchy(*hierarchy);
  const Teuchos::RCP<const Operator> M =
      Teuchos::rcp(new MueLu::TpetraOperator<double, int, long long, Node>(hierarchy));
  const auto x = Teuchos::rcp(new MultiVector(stokes.map, 1));
  const auto problem =
      Teuchos::rcp(new Belos::LinearProblem<double, MultiVector, Operator>(stokes.K, x, stokes.b));
  problem->setRightPrec(M);
  problem->setProblem();
  const auto of_belos = Teuchos::rcp(new Teuchos::ParameterList);
  of_belos->set("Flexible Gmres", true).set("Convergence Tolerance", 1e-8);
  Belos::BlockGmresSolMgr<double, MultiVector, Operator>(problem, of_belos).solve();
  return residual(stokes, *x);
}

bool run(const char* path) {
  const Stokes stokes(10);
  const auto list = Teuchos::getParametersFromXmlFile(path);
  const double one = by_stratimikos(stokes, list);
  const double other = by_muelu(
      stokes, list->sublist("Preconditioner Types").sublist("Tunica Cycle").sublist("MueLu"));
  if (stokes.map->getComm()->getRank() == 0)
    std::printf("Stratimikos %10.2e\nMueLu       %10.2e\n", one, other);
  return one < 1.1e-8 && other < 1.1e-8;
}

}  // namespace

int main(int argc, char** argv) {
  Tpetra::ScopeGuard session(&argc, &argv);
  try {
    return argc == 2 && run(argv[1]) ? 0 : 1;
  } catch (const std::exception& error) {
    std::fprintf(stderr, "registered: %s\n", error.what());
    return 1;
  }
}
