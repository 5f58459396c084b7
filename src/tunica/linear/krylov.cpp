#include "tunica/linear/krylov.hpp"

#include <BelosLinearProblem.hpp>
#include <BelosSolverFactory_Tpetra.hpp>
#include <BelosTpetraAdapter.hpp>
#include <cmath>
#include <limits>

#include "tunica/base/fault_point.hpp"
#include "tunica/base/stop_signals.hpp"
#include "tunica/io/progress.hpp"

namespace tunica::linear {

namespace {

Teuchos::RCP<Teuchos::ParameterList> belos_list(const KrylovOptions& options, double tolerance) {
  const auto list = Teuchos::rcp(new Teuchos::ParameterList);
  list->set("Maximum Iterations", options.max_iterations);
  list->set("Convergence Tolerance", tolerance);
  // Recycled directions stand in the basis beside those of a cycle.
  if (options.restart > 0) {
    list->set("Num Blocks",
              std::min(options.restart, options.max_iterations) + options.most_recycled);
    list->set("Maximum Restarts", options.max_iterations / options.restart + 1);
  }
  if (!options.stagnation.is_null() && options.method == "GCR")
    list->set("Stagnation", options.stagnation);
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

/// The matrix, which looks for signals that want to end the program while a method of Belos applies
/// it; GCR does so by itself. A message in each fourth product is what that costs.
class WatchfulOperator final : public Operator {
public:
  WatchfulOperator(const Teuchos::RCP<const Operator>& A, std::string method)
      : A_(A), method_(std::move(method)) {}

  void apply(const MultiVector& X, MultiVector& Y, Teuchos::ETransp mode, Scalar alpha,
             Scalar beta) const override {
    if (++count_ % 4 == 0) stop_if_urgent(*A_->getDomainMap()->getComm());
    io::report_progress([this] { return method_ + ", product " + std::to_string(count_); });
    A_->apply(X, Y, mode, alpha, beta);
  }
  Teuchos::RCP<const Map> getDomainMap() const override { return A_->getDomainMap(); }
  Teuchos::RCP<const Map> getRangeMap() const override { return A_->getRangeMap(); }

private:
  Teuchos::RCP<const Operator> A_;
  std::string method_;
  mutable int count_ = 0;
};

bool has_stagnated(const Belos::SolverManager<Scalar, MultiVector, Operator>& solver) {
  const auto* const gcr = dynamic_cast<const Gcr*>(&solver);
  return gcr != nullptr && gcr->has_stagnated();
}

}  // namespace

// A P⁻¹ y = b, x = P⁻¹ y: preconditioned from the right, the residual is that of the system itself.
KrylovResult solve_krylov(const KrylovOptions& options, const Teuchos::RCP<const Operator>& A,
                          const Teuchos::RCP<const Operator>& preconditioner, const MultiVector& B,
                          MultiVector& X, double tolerance) {
  const auto x = Teuchos::rcpFromRef(X);
  Teuchos::RCP<const Operator> K = A;
  if (options.method != "GCR") K = Teuchos::rcp(new WatchfulOperator(A, options.method));
  const auto problem = Teuchos::rcp(
      new Belos::LinearProblem<Scalar, MultiVector, Operator>(K, x, Teuchos::rcpFromRef(B)));
  if (!preconditioner.is_null()) problem->setRightPrec(preconditioner);
  // Belos would multiply a start of zeros by A. GCR needs no more than what the problem holds.
  if (options.method != "GCR") problem->setProblem();
  const auto solver = make_solver(options.method, belos_list(options, tolerance));
  solver->setProblem(problem);
  fault_point("krylov solve");
  try {
    solver->solve();
    return {solver->getNumIters(), solver->achievedTol(), has_stagnated(*solver)};
  } catch (const Belos::BelosError&) {  // breakdown: the caller's true residual tells
    return {solver->getNumIters(), std::numeric_limits<double>::quiet_NaN()};
  }
}

}  // namespace tunica::linear
