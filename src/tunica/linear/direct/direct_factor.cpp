#include "tunica/linear/direct/direct_factor.hpp"

#include <stdexcept>
#include <string>

#include "tunica/algebra/static_matrix.hpp"
#include "tunica/base/attempt.hpp"
#include "tunica/base/fault_point.hpp"
#include "tunica/base/formatted.hpp"
#include "tunica/base/trilinos.hpp"
#include "tunica/smoothers/direct/sparse_lu.hpp"

namespace tunica::linear {

namespace {

/// Operations per entry up to which the first order is kept: another would save less than it takes.
constexpr double few_operations = 3000.0;

/// Nested dissection takes at most this part of the operations of the first order.
constexpr double most_gain = 0.5;

/// Per entry of the matrix, with an order by nested dissection where that may be worth its time.
double operations_of(MultifrontalLu& factors, double entries, double most) {
  const double first = factors.expected_operations() / entries;
  if (!factors.is_ordered()) return first;
  if (first > few_operations && (most == 0.0 || most_gain * first <= most)) factors.dissect();
  return factors.expected_operations() / entries;
}

}  // namespace

DirectFactor::DirectFactor(const Teuchos::RCP<const CrsMatrix>& matrix, double most_operations)
    : matrix_(matrix) {
  set_up(*matrix_->getComm(), "the direct solver", [this, most_operations] {
    const double most = most_operations * static_cast<double>(matrix_->getGlobalNumEntries());
    factors_ = std::make_unique<smoothers::SparseLu>(matrix_, [most](const auto& alone) {
      return std::make_unique<MultifrontalLu>(alone, most);
    });
    set_order(most_operations);
  });
}

void DirectFactor::set_order(double most) {
  const auto entries = static_cast<double>(matrix_->getGlobalNumEntries());
  const double found = factors_->told([&](smoothers::Factors& factors) {
    return operations_of(dynamic_cast<MultifrontalLu&>(factors), entries, most);
  });
  if (most > 0.0 && found > most)
    throw SetupFailure(
        formatted("factors would take %.0f operations per entry or more, and %.0f are permitted",
                  found, most));
}

double DirectFactor::expected_bytes() const {
  return factors_->told([](const smoothers::Factors& factors) {
    return dynamic_cast<const MultifrontalLu&>(factors).expected_bytes();
  });
}

DirectFactor::~DirectFactor() = default;

// A singular matrix is a result for Newton's method. All ranks get it, whichever has found it.
void DirectFactor::refresh() {
  const Outcome outcome = attempt(*matrix_->getComm(), "factoring a matrix", [this] {
    fault_point("direct set-up");
    factors_->refactor();
  });
  if (outcome.is_success()) return;
  if (outcome.reason().find("singular") == std::string::npos)
    throw SetupFailure("the factors cannot be made: " + outcome.reason());
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

double factor_operations(const Teuchos::RCP<const CrsGraph>& graph, double enough) {
  double operations = 0.0;
  set_up(*graph->getComm(), "the count of operations", [&] {
    const smoothers::SparseLu factors(algebra::matrix_on(graph), [enough](const auto& alone) {
      return std::make_unique<MultifrontalLu>(alone, enough);
    });
    operations = factors.told([](const smoothers::Factors& all) {
      return dynamic_cast<const MultifrontalLu&>(all).expected_operations();
    });
  });
  return operations;
}

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
  smoothers::SparseLu factors(A);
  factors.refactor();
  factors.solve(b, x);
  // |b − A x| < 10⁻¹² |b|
  A->apply(x, r);
  r.update(1.0, b, -1.0);
  if (!(r.norm2() < 1e-12 * b.norm2()))
    throw std::runtime_error(
        "KLU2 solves a 6-by-6 system per rank wrongly: this executable was linked without "
        "the repair in tunica/smoothers/direct/klu2_repair.cpp (link Tunica::smoothers).");
}

}  // namespace tunica::linear
