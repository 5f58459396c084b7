#include "linear/linear_solver.hpp"

#include <Teuchos_TimeMonitor.hpp>
#include <cmath>

#include "linear/direct_factor.hpp"
#include "linear/ilu.hpp"
#include "linear/krylov.hpp"
#include "linear/merged_matrix.hpp"

namespace tunica::linear {

namespace {

double seconds() { return Teuchos::Time::wallTime(); }

double relative_residual(const CrsMatrix& K, const Vector& b, const Vector& x) {
  Vector r(b.getMap());
  K.apply(x, r);
  r.update(1.0, b, -1.0);
  const double size = b.norm2();
  return size > 0.0 ? r.norm2() / size : 0.0;
}

/// Solves the merged system; derived classes say how.
class MergedSolver : public LinearSolver {
public:
  explicit MergedSolver(const fields::BlockOperator& K)
      : K_(K), b_(K_.matrix()->getRangeMap()), x_(K_.matrix()->getDomainMap()) {}

  void matrix_changed() override { is_stale_ = true; }

  SolveReport solve(const fields::BlockVector& b, fields::BlockVector& x,
                    double tolerance) override {
    SolveReport report;
    report.tolerance = tolerance;
    if (is_stale_) K_.refresh();
    K_.merge(b, b_);
    x_.putScalar(0.0);
    solve_merged(report);
    report.true_residual = relative_residual(*K_.matrix(), b_, x_);
    K_.split(x_, x);
    is_stale_ = false;
    return report;
  }

protected:
  virtual void solve_merged(SolveReport& report) = 0;

  MergedMatrix K_;
  Vector b_, x_;
  bool is_stale_ = true;
};

class DirectSolver final : public MergedSolver {
public:
  explicit DirectSolver(const fields::BlockOperator& K) : MergedSolver(K), factor_(K_.matrix()) {}

private:
  void solve_merged(SolveReport& report) override {
    report.method = "direct";
    const double start = seconds();
    if (is_stale_) factor_.refresh();
    const double ready = seconds();
    factor_.apply(b_, x_);
    report.iterations = 1;
    report.setup_seconds = ready - start;
    report.solve_seconds = seconds() - ready;
    report.recurrence_residual = relative_residual(*K_.matrix(), b_, x_);
    report.is_converged = report.recurrence_residual <= std::max(report.tolerance, 1e-8);
  }

  DirectFactor factor_;
};

/// A preconditioner of the merged matrix that is kept until it has become too weak.
class Preconditioner {
public:
  Preconditioner(const Teuchos::ParameterList& options, const Teuchos::RCP<CrsMatrix>& matrix) {
    const auto& kind = options.get<std::string>("preconditioner");
    if (kind == "direct") direct_ = Teuchos::rcp(new DirectFactor(matrix));
    if (kind == "ilu")
      ilu_ = std::make_unique<IluPreconditioner>(matrix, options.get<int>("fill level"),
                                                 options.get<int>("overlap"));
  }
  void refresh() {
    if (!direct_.is_null()) direct_->refresh();
    if (ilu_) ilu_->refresh();
  }
  Teuchos::RCP<const Operator> as_operator() const {
    if (!direct_.is_null()) return direct_;
    if (ilu_) return ilu_->as_operator();
    return Teuchos::null;
  }

private:
  Teuchos::RCP<DirectFactor> direct_;
  std::unique_ptr<IluPreconditioner> ilu_;
};

class KrylovSolver final : public MergedSolver {
public:
  KrylovSolver(const Teuchos::ParameterList& options, const fields::BlockOperator& K)
      : MergedSolver(K),
        options_{options.get<std::string>("method"), options.get<int>("max iterations"),
                 options.isParameter("restart") ? options.get<int>("restart") : 0},
        refresh_factor_(options.get<double>("refresh factor")),
        preconditioner_(options, K_.matrix()) {
    for (char& c : options_.method) c = static_cast<char>(std::toupper(c));
  }

private:
  void solve_merged(SolveReport& report) override {
    report.method = options_.method;
    const bool is_kept = fresh_iterations_ >= 0 && last_iterations_ <= limit();
    if (is_stale_ && !is_kept) refresh(report);
    iterate(report);
    if (!report.is_converged && is_kept && is_old_) {
      refresh(report);
      x_.putScalar(0.0);
      iterate(report);
    }
    last_iterations_ = report.iterations;
    if (!is_old_) fresh_iterations_ = report.iterations;
    is_old_ = true;
  }

  /// Iterations up to which an old preconditioner is worth keeping. The few added keep one that
  /// starts with a single iteration, as factors do.
  double limit() const { return refresh_factor_ * (fresh_iterations_ + 5); }

  void refresh(SolveReport& report) {
    const double start = seconds();
    preconditioner_.refresh();
    is_old_ = false;
    report.setup_seconds += seconds() - start;
  }

  void iterate(SolveReport& report) {
    const double start = seconds();
    const KrylovResult result = solve_krylov(options_, K_.matrix(), preconditioner_.as_operator(),
                                             b_, x_, report.tolerance);
    report.iterations += result.iterations;
    report.recurrence_residual = result.recurrence_residual;
    // The recurrence of a Krylov method may drift from the truth by round-off, not by more.
    report.is_converged =
        relative_residual(*K_.matrix(), b_, x_) <= 2.0 * report.tolerance + 1e-14;
    report.solve_seconds += seconds() - start;
  }

  KrylovOptions options_;
  double refresh_factor_;
  int fresh_iterations_ = -1;  ///< of the first solve after a set-up; -1 before any
  int last_iterations_ = 0;
  bool is_old_ = false;        ///< the preconditioner has served a solve already
  Preconditioner preconditioner_;
};

params::Table krylov_table(bool has_restart) {
  params::Table ilu, direct, none, table;
  ilu.integer("fill level", 0, params::non_negative(), "levels of fill k of ILU(k)");
  ilu.integer("overlap", 0, params::non_negative(), "overlap between ranks, in graph layers");
  table.variant("preconditioner", "ilu",
                {{"ilu", ilu}, {"direct", direct}, {"none", none}},
                "right preconditioner: incomplete LU with additive Schwarz between ranks, sparse "
                "LU factors (worth it where they are kept), or none");
  table.integer("max iterations", 1000, params::between(1, 1e6), "cap on the iterations");
  table.number("refresh factor", 2.0, params::non_negative(), "1",
               "set up a new preconditioner when a solve takes more than this times the "
               "iterations of the first solve with it; 0 sets up a new one for each matrix");
  if (has_restart)
    table.integer("restart", 200, params::between(1, 1e6), "basis vectors between restarts");
  return table;
}

}  // namespace

params::Table linear_solver_table() {
  params::Table table("Solves the linear systems of Newton's method.");
  table.variant("method", "flexible gmres",
                {{"direct", params::Table("sparse LU on rank 0, for small systems")},
                 {"flexible gmres", krylov_table(true)},
                 {"gmres", krylov_table(true)},
                 {"bicgstab", krylov_table(false)}},
                "sparse direct (Amesos2 KLU2) or a Krylov method (Belos)");
  return table;
}

std::unique_ptr<LinearSolver> make_linear_solver(const Teuchos::ParameterList& options,
                                                 const fields::BlockOperator& K) {
  if (options.get<std::string>("method") == "direct") return std::make_unique<DirectSolver>(K);
  return std::make_unique<KrylovSolver>(options, K);
}

}  // namespace tunica::linear
