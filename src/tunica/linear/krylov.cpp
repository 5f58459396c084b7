#include "tunica/linear/krylov.hpp"

#include <BelosLinearProblem.hpp>
#include <BelosSolverFactory_Tpetra.hpp>
#include <BelosTpetraAdapter.hpp>
#include <cmath>
#include <limits>

#include "tunica/base/fault_point.hpp"

namespace tunica::linear {

namespace {

Teuchos::RCP<Teuchos::ParameterList> belos_list(const KrylovOptions& options, double tolerance) {
  const auto list = Teuchos::rcp(new Teuchos::ParameterList);
  list->set("Maximum Iterations", options.max_iterations);
  list->set("Convergence Tolerance", tolerance);
  // CG starts from a guess; Belos would reduce the guess's residual, however small, further.
  if (options.method == "CG") list->set("Implicit Residual Scaling", "Norm of RHS");
  if (options.restart > 0) {
    list->set("Num Blocks",
              std::min(options.restart, options.max_iterations) + options.most_recycled);
    list->set("Maximum Restarts", options.max_iterations / options.restart + 1);
  }
  if (!options.recycled.is_null()) {
    list->set("Recycled Directions", options.recycled);
    list->set("Num Recycled Blocks", options.most_recycled);
  }
  return list;
}

// A factory of ours, added to Belos's with each solve, would stay in a list of the program, which
// is searched from its start.
Teuchos::RCP<Belos::SolverManager<Scalar, MultiVector, Operator>> make_solver(
    const std::string& method, const Teuchos::RCP<Teuchos::ParameterList>& list) {
  if (method == "GCR") return Teuchos::rcp(new Gcr(list));
  return Belos::SolverFactory<Scalar, MultiVector, Operator>().create(method, list);
}

}  // namespace

KrylovResult solve_krylov(const KrylovOptions& options, const Teuchos::RCP<const Operator>& A,
                          const Teuchos::RCP<const Operator>& preconditioner, const MultiVector& B,
                          MultiVector& X, double tolerance) {
  const auto x = Teuchos::rcpFromRef(X);
  const auto problem = Teuchos::rcp(
      new Belos::LinearProblem<Scalar, MultiVector, Operator>(A, x, Teuchos::rcpFromRef(B)));
  if (!preconditioner.is_null()) problem->setRightPrec(preconditioner);
  problem->setProblem();
  const auto solver = make_solver(options.method, belos_list(options, tolerance));
  solver->setProblem(problem);
  fault_point("krylov solve");
  try {
    solver->solve();
    return {solver->getNumIters(), solver->achievedTol()};
  } catch (const Belos::BelosError&) {  // breakdown: the caller's true residual tells
    return {solver->getNumIters(), std::numeric_limits<double>::quiet_NaN()};
  }
}

}  // namespace tunica::linear
