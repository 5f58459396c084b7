#include "tunica/linear/scalar_solver.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

#include "tunica/algebra/components.hpp"
#include "tunica/io/progress.hpp"
#include "tunica/linear/amg.hpp"
#include "tunica/linear/direct/direct_factor.hpp"
#include "tunica/linear/solvers/conjugate_gradients.hpp"

namespace tunica::linear {

namespace {

using Norms = std::vector<double>;  ///< of each column

Norms norms(const MultiVector& X) {
  Norms found(X.getNumVectors());
  X.norm2(Teuchos::arrayViewFromVector(found));
  return found;
}

// R = B − K X
MultiVector residual_of(const CrsMatrix& K, const MultiVector& B, const MultiVector& X) {
  MultiVector R(B, Teuchos::Copy);
  K.apply(X, R, Teuchos::NO_TRANS, -1.0, 1.0);
  return R;
}

// max_j |r_j|/|b_j| over the columns; what is no number is infinite
double largest_ratio(const Norms& r, const Norms& b) {
  double largest = 0.0;
  for (std::size_t j = 0; j < r.size(); ++j) {
    if (!std::isfinite(r[j])) return std::numeric_limits<double>::infinity();
    if (b[j] > 0.0) largest = std::max(largest, r[j] / b[j]);
  }
  return largest;
}

// (Σ_j |r_j|² / Σ_j |b_j|²)^½: a column that is next to zero does not count for itself
double common_ratio(const Norms& r, const Norms& b) {
  const double of_b = std::inner_product(b.begin(), b.end(), b.begin(), 0.0);
  const double of_r = std::inner_product(r.begin(), r.end(), r.begin(), 0.0);
  return of_b > 0.0 ? std::sqrt(of_r / of_b) : 0.0;
}

class DirectScalarSolver final : public ScalarSolver {
public:
  explicit DirectScalarSolver(const Teuchos::RCP<CrsMatrix>& K) : K_(K), factor_(K) {
    factor_.refresh();
  }
  // Factors need no start, and reach their tolerance whatever else is asked for.
  ScalarAnswer solve_to(const ScalarGoal& goal, const MultiVector& B, MultiVector& X) override {
    factor_.apply(B, X);
    return {largest_ratio(norms(residual_of(*K_, B, X)), norms(B)), goal.tolerance};
  }
  double tolerance() const override { return 1e-10; }

private:
  Teuchos::RCP<CrsMatrix> K_;
  DirectFactor factor_;
};

/// Conjugate gradients, and complete factors where they do not reach their goal.
class CgSolver final : public ScalarSolver {
public:
  /// preconditioner: of K.
  CgSolver(const Teuchos::ParameterList& options, const Teuchos::RCP<CrsMatrix>& K,
           const Teuchos::RCP<Operator>& preconditioner)
      : K_(K), max_iterations_(options.get<int>("max iterations")),
        tolerance_(options.get<double>("tolerance")), preconditioner_(preconditioner),
        may_factor_(K->getGlobalNumRows() <=
                    static_cast<Tpetra::global_size_t>(options.get<int>("direct unknowns"))) {}

  ScalarAnswer solve_to(const ScalarGoal& goal, const MultiVector& B, MultiVector& X) override {
    // R = B − K X, to fall to max(τ, reduction · min(0.01, |R|/|B|)) |b| in each column
    MultiVector R = goal.starts_from_zero ? MultiVector(B, Teuchos::Copy) : residual_of(*K_, B, X);
    const Norms b = norms(B), start = norms(R);
    constexpr double most = 0.01;
    const double change = common_ratio(start, b);
    const double wanted =
        std::max(goal.tolerance, goal.reduction * (change < most ? change : most));
    Norms goals(b);
    for (double& size : goals) size *= wanted;
    // K x = 0 has the solution zero, which no iteration reaches.
    for (std::size_t j = 0; j < b.size(); ++j)
      if (b[j] == 0.0)
        for (MultiVector* V : {&R, &X}) V->getVectorNonConst(j)->putScalar(0.0);
    iterate(goals, start, R, X);
    // Round-off parts what the recurrence says from the truth at 1e-12 or so.
    constexpr double trusted = 1e-9;
    if (wanted < trusted) R = residual_of(*K_, B, X);
    const ScalarAnswer answer{largest_ratio(norms(R), b), wanted};
    if (answer.is_good() || !may_factor_) return answer;
    if (!factors_) {
      io::announce(
          "conjugate gradients do not reach their tolerance; sparse LU factors are used instead");
      factors_ = std::make_unique<DirectScalarSolver>(K_);
    }
    return factors_->solve_to({wanted}, B, X);
  }
  double tolerance() const override { return tolerance_; }

private:
  // Columns together share their messages; where there are none, Tpetra is quicker one by one.
  void iterate(const Norms& goals, const Norms& start, MultiVector& R, MultiVector& X) const {
    const auto is_open = [&](std::size_t j) { return goals[j] > 0.0 && !(start[j] <= goals[j]); };
    bool any = false;
    for (std::size_t j = 0; j < goals.size(); ++j) any = any || is_open(j);
    if (!any) return;
    if (K_->getComm()->getSize() > 1) {
      conjugate_gradients(*K_, *preconditioner_, goals, max_iterations_, R, X);
      return;
    }
    for (std::size_t j = 0; j < goals.size(); ++j)
      if (is_open(j))
        conjugate_gradients(*K_, *preconditioner_, {goals[j]}, max_iterations_,
                            *R.getVectorNonConst(j), *X.getVectorNonConst(j));
  }

  Teuchos::RCP<CrsMatrix> K_;
  int max_iterations_;
  double tolerance_;
  Teuchos::RCP<Operator> preconditioner_;
  bool may_factor_;
  std::unique_ptr<DirectScalarSolver> factors_;  ///< null before they are needed
};

/// diag(M, M, M) of an operator M for one component.
class ForEachComponent final : public Operator {
public:
  ForEachComponent(const Teuchos::RCP<Operator>& M, const Teuchos::RCP<const Map>& map)
      : M_(M), map_(map) {}

  Teuchos::RCP<const Map> getDomainMap() const override { return map_; }
  Teuchos::RCP<const Map> getRangeMap() const override { return map_; }
  void apply(const MultiVector& X, MultiVector& Y, Teuchos::ETransp, double alpha,
             double beta) const override {
    MultiVector x(M_->getDomainMap(), 3), y(M_->getRangeMap(), 3);
    MultiVector result(map_, 1);
    for (std::size_t j = 0; j < X.getNumVectors(); ++j) {
      // (M x_1, M x_2, M x_3) of the components of x
      algebra::to_columns(*X.getVector(j), x);
      M_->apply(x, y);
      algebra::from_columns(y, result);
      Y.getVectorNonConst(j)->update(alpha, result, beta);
    }
  }

private:
  Teuchos::RCP<Operator> M_;
  Teuchos::RCP<const Map> map_;
};

/// Takes components as columns.
class VectorSolver final : public ScalarSolver {
public:
  VectorSolver(std::unique_ptr<ScalarSolver> solver, const Teuchos::RCP<const Map>& map)
      : solver_(std::move(solver)), b_(map, 1), x_(map, 1) {}

  ScalarAnswer solve_to(const ScalarGoal& goal, const MultiVector& B, MultiVector& X) override {
    algebra::from_columns(B, b_);
    algebra::from_columns(X, x_);
    const ScalarAnswer answer = solver_->solve_to(goal, b_, x_);
    algebra::to_columns(x_, X);
    return answer;
  }
  double tolerance() const override { return solver_->tolerance(); }

private:
  std::unique_ptr<ScalarSolver> solver_;
  MultiVector b_, x_;
};

bool is_direct(const Teuchos::ParameterList& options) {
  return options.get<std::string>("method") == "direct";
}

}  // namespace

params::Table scalar_solver_table() {
  params::Table cg,
      table("Solves symmetric positive definite systems with one unknown per node, or a few.");
  cg.number("tolerance", 1e-12, params::Range{0.0, 1.0, true, true}, "1",
            "reduction of the residual")
      .integer("max iterations", 200, params::between(1, 1e6), "cap on the iterations")
      .integer("direct unknowns", 300000, params::between(0, 1e9),
               "largest system that sparse LU solves if that cap is reached");
  table.variant("method", "cg",
                {{"cg", cg}, {"direct", params::Table("sparse LU on rank 0, for small systems")}},
                "conjugate gradients with smoothed-aggregation multigrid, or sparse direct");
  return table;
}

std::unique_ptr<ScalarSolver> make_scalar_solver(const Teuchos::ParameterList& options,
                                                 const Teuchos::RCP<CrsMatrix>& K) {
  if (is_direct(options)) return std::make_unique<DirectScalarSolver>(K);
  return std::make_unique<CgSolver>(options, K, make_amg(K));
}

std::unique_ptr<ScalarSolver> make_vector_solver(const Teuchos::ParameterList& options,
                                                 const Teuchos::RCP<CrsMatrix>& K,
                                                 const Teuchos::RCP<CrsMatrix>& L) {
  // c L ≤ K ≤ C L in each component (Korn), so that diag(M, M, M) with the cycle M for L
  // preconditions K: iterations depend on C/c.
  const Teuchos::RCP<const Map> map = K->getRowMap();
  std::unique_ptr<ScalarSolver> solver;
  if (is_direct(options)) {
    solver = std::make_unique<DirectScalarSolver>(K);
  } else {
    const auto M = Teuchos::rcp(new ForEachComponent(make_amg(L), map));
    solver = std::make_unique<CgSolver>(options, K, M);
  }
  return std::make_unique<VectorSolver>(std::move(solver), map);
}

}  // namespace tunica::linear
