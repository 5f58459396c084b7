#include "tunica/linear/direct_factor.hpp"

#include <stdexcept>

#include "tunica/base/attempt.hpp"
#include "tunica/base/fault_point.hpp"
#include "tunica/base/trilinos.hpp"

namespace tunica::linear {

DirectFactor::DirectFactor(const Teuchos::RCP<const CrsMatrix>& matrix) : matrix_(matrix) {
  set_up(*matrix_->getComm(), "the direct solver",
         [this] { factors_ = std::make_unique<smoothers::SparseLu>(matrix_); });
}

DirectFactor::~DirectFactor() = default;

// A singular matrix is a result for Newton's method. All ranks get it, whichever has found it.
void DirectFactor::refresh() {
  const Outcome outcome = attempt(*matrix_->getComm(), "factoring a matrix", [this] {
    fault_point("direct set-up");
    factors_->refactor();
  });
  if (outcome.is_failure())
    throw SetupFailure("the matrix is singular: are all rigid motions held, is a pressure given?");
}

// Y ← α K⁻¹ X + β Y
void DirectFactor::apply(const MultiVector& X, MultiVector& Y, Teuchos::ETransp mode, Scalar alpha,
                         Scalar beta) const {
  if (mode != Teuchos::NO_TRANS) throw std::logic_error("DirectFactor: no transposed solve");
  MultiVector solution(Y.getMap(), Y.getNumVectors());
  factors_->solve(X, solution);
  Y.update(alpha, solution, beta);
}

Teuchos::RCP<const Map> DirectFactor::getDomainMap() const { return matrix_->getRangeMap(); }
Teuchos::RCP<const Map> DirectFactor::getRangeMap() const { return matrix_->getDomainMap(); }

// A = tridiag(−2, 4, −1) is not symmetric and has both factors, so that a solve that leaves out one
// of them shows in r = b − A x.
void check_direct_solver(const CommPtr& comm) {
  const int n = 6 * comm->getSize();
  const Teuchos::RCP<const Map> map = Teuchos::rcp(new Map(n, 0, comm));
  const auto A = Teuchos::rcp(new CrsMatrix(map, 3));
  for (const GlobalOrdinal row : global_numbers(*map)) {
    if (row > 0)
      A->insertGlobalValues(row, Teuchos::tuple<GlobalOrdinal>(row - 1), Teuchos::tuple(-2.0));
    A->insertGlobalValues(row, Teuchos::tuple<GlobalOrdinal>(row), Teuchos::tuple(4.0));
    if (row < n - 1)
      A->insertGlobalValues(row, Teuchos::tuple<GlobalOrdinal>(row + 1), Teuchos::tuple(-1.0));
  }
  A->fillComplete();
  Vector x(map), b(map), r(map);
  b.putScalar(1.0);
  DirectFactor factor(A);
  factor.refresh();
  factor.apply(b, x);
  // |b − A x| < 10⁻¹² |b|
  A->apply(x, r);
  r.update(1.0, b, -1.0);
  if (!(r.norm2() < 1e-12 * b.norm2()))
    throw std::runtime_error(
        "KLU2 solves a 6-by-6 system per rank wrongly: this executable was linked without "
        "the repair in tunica/smoothers/direct/klu2_repair.cpp (link Tunica::smoothers).");
}

}  // namespace tunica::linear
