#include "tunica/linear/scalar_solver.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "tunica/linear/amg.hpp"
#include "tunica/linear/direct_factor.hpp"
#include "tunica/linear/krylov.hpp"

namespace tunica::linear {

namespace {

double relative_residual(const CrsMatrix& K, const MultiVector& B, const MultiVector& X) {
  MultiVector R(B, Teuchos::Copy);
  K.apply(X, R, Teuchos::NO_TRANS, -1.0, 1.0);
  std::vector<double> r(B.getNumVectors()), b(B.getNumVectors());
  R.norm2(Teuchos::arrayViewFromVector(r));
  B.norm2(Teuchos::arrayViewFromVector(b));
  double largest = 0.0;
  for (std::size_t j = 0; j < r.size(); ++j) {
    if (!std::isfinite(r[j])) return std::numeric_limits<double>::infinity();
    if (b[j] > 0.0) largest = std::max(largest, r[j] / b[j]);
  }
  return largest;
}

class DirectScalarSolver final : public ScalarSolver {
public:
  explicit DirectScalarSolver(const Teuchos::RCP<CrsMatrix>& K) : K_(K), factor_(K) {
    factor_.refresh();
  }
  double solve_to(double, const MultiVector& B, MultiVector& X) override {
    factor_.apply(B, X);
    return relative_residual(*K_, B, X);
  }
  double tolerance() const override { return 1e-10; }

private:
  Teuchos::RCP<CrsMatrix> K_;
  DirectFactor factor_;
};

class CgSolver final : public ScalarSolver {
public:
  CgSolver(const Teuchos::ParameterList& options, const Teuchos::RCP<CrsMatrix>& K)
      : K_(K), options_{"CG", options.get<int>("max iterations"), 0},
        tolerance_(options.get<double>("tolerance")), multigrid_(make_amg(K)) {}

  double solve_to(double tolerance, const MultiVector& B, MultiVector& X) override {
    // Columns together share their messages; where there are none, Tpetra is quicker one by one.
    if (K_->getComm()->getSize() > 1)
      solve_krylov(options_, K_, multigrid_, B, X, tolerance);
    else
      for (std::size_t j = 0; j < B.getNumVectors(); ++j)
        solve_krylov(options_, K_, multigrid_, *B.getVector(j), *X.getVectorNonConst(j), tolerance);
    return relative_residual(*K_, B, X);
  }
  double tolerance() const override { return tolerance_; }

private:
  Teuchos::RCP<CrsMatrix> K_;
  KrylovOptions options_;
  double tolerance_;
  Teuchos::RCP<Operator> multigrid_;
};

}  // namespace

params::Table scalar_solver_table() {
  params::Table cg, table("Solves symmetric positive definite systems with one unknown per node.");
  cg.number("tolerance", 1e-12, params::Range{0.0, 1.0, true, true}, "1",
            "reduction of the residual")
      .integer("max iterations", 200, params::between(1, 1e6), "cap on the iterations");
  table.variant("method", "cg",
                {{"cg", cg}, {"direct", params::Table("sparse LU on rank 0, for small systems")}},
                "conjugate gradients with smoothed-aggregation multigrid, or sparse direct");
  return table;
}

std::unique_ptr<ScalarSolver> make_scalar_solver(const Teuchos::ParameterList& options,
                                                 const Teuchos::RCP<CrsMatrix>& K) {
  if (options.get<std::string>("method") == "direct")
    return std::make_unique<DirectScalarSolver>(K);
  return std::make_unique<CgSolver>(options, K);
}

}  // namespace tunica::linear
