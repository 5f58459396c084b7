// Solves a saddle-point system by Belos' flexible GMRES, preconditioned by multigrid whose smoother
// a MueLu list names, for every list on the command line.
//
//   smoothers vanka.xml node-ilu.xml braess-sarazin.xml
//   mpirun -n 2 smoothers vanka.xml
//
// Exit status: 0 all converged, 1 some did not or a list is refused.
#include <BelosBlockGmresSolMgr.hpp>
#include <BelosTpetraAdapter.hpp>
#include <Teuchos_XMLParameterListHelpers.hpp>
#include <cstdio>
#include <exception>

#include "stokes.hpp"
#include "tunica/multigrid/muelu/cycle.hpp"

namespace {

struct Result {
  int iterations;
  double residual;  // |b − K x| / |b|
};

Result solve(const Stokes& stokes, const Teuchos::RCP<const Operator>& M) {
  const auto x = Teuchos::rcp(new MultiVector(stokes.map, stokes.b->getNumVectors()));
  const auto problem =
      Teuchos::rcp(new Belos::LinearProblem<double, MultiVector, Operator>(stokes.K, x, stokes.b));
  problem->setRightPrec(M);
  problem->setProblem();
  const auto list = Teuchos::rcp(new Teuchos::ParameterList);
  list->set("Flexible Gmres", true).set("Convergence Tolerance", 1e-8).set("Num Blocks", 100);
  Belos::BlockGmresSolMgr<double, MultiVector, Operator> solver(problem, list);
  solver.solve();
  MultiVector r(*stokes.b, Teuchos::Copy);
  stokes.K->apply(*x, r, Teuchos::NO_TRANS, -1.0, 1.0);
  Teuchos::Array<double> of_r(1), of_b(1);
  r.norm2(of_r());
  stokes.b->norm2(of_b());
  return {solver.getNumIters(), of_r[0] / of_b[0]};
}

bool run(int argc, char** argv) {
  const Stokes stokes(12);
  const bool is_root = stokes.map->getComm()->getRank() == 0;
  bool is_good = argc > 1;
  for (int i = 1; i < argc; ++i) {
    const auto list = Teuchos::getParametersFromXmlFile(argv[i]);
    // Three components of velocity: unknowns 4 * node + 0, 1, 2, and the pressure 4 * node + 3.
    const auto M = Teuchos::rcp(new tunica::multigrid::Cycle(stokes.K, 3, *list));
    const Result result = solve(stokes, M);
    is_good &= result.residual < 1.1e-8;
    if (is_root) std::printf("%-40s %4d %10.2e\n", argv[i], result.iterations, result.residual);
  }
  return is_good;
}

}  // namespace

int main(int argc, char** argv) {
  Tpetra::ScopeGuard session(&argc, &argv);
  try {
    return run(argc, argv) ? 0 : 1;
  } catch (const std::exception& error) {
    std::fprintf(stderr, "smoothers: %s\n", error.what());
    return 1;
  }
}
