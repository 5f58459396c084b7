#include "tunica/linear/linear_solver.hpp"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <sstream>

#include "tunica/algebra/merged_matrix.hpp"
#include "tunica/base/timer.hpp"
#include "tunica/linear/counting_operator.hpp"
#include "tunica/linear/direct_factor.hpp"
#include "tunica/linear/krylov.hpp"
#include "tunica/linear/refresh_rule.hpp"

namespace tunica::linear {

namespace {

double relative_residual(const Operator& K, const MultiVector& b, const MultiVector& x) {
  MultiVector r(b.getMap(), 1);
  K.apply(x, r);
  r.update(1.0, b, -1.0);
  double size = 0.0, rest = 0.0;
  b.norm2(Teuchos::ArrayView<double>(&size, 1));
  r.norm2(Teuchos::ArrayView<double>(&rest, 1));
  return size == 0.0 ? 0.0 : rest / size;
}

class DirectSolver final : public LinearSolver {
public:
  explicit DirectSolver(const algebra::BlockMatrix& K)
      : K_(K), factor_(K_.matrix()), b_(K_.matrix()->getRowMap()), x_(b_.getMap()) {}

  void matrix_changed() override { is_stale_ = true; }

  void prepare() override {
    K_.refresh();
    factor_.refresh();
    is_stale_ = false;
  }

  SolveReport solve(const algebra::BlockVector& b, algebra::BlockVector& x,
                    double tolerance) override {
    SolveReport report;
    report.method = "direct";
    report.tolerance = tolerance;
    const Stopwatch set_up;
    if (is_stale_) prepare();
    report.setup_seconds = set_up.seconds();
    const Stopwatch solving;
    K_.merge(b, b_);
    factor_.apply(b_, x_);
    K_.split(x_, x);
    report.solve_seconds = solving.seconds();
    report.iterations = 1;
    report.true_residual = relative_residual(*K_.matrix(), b_, x_);
    report.recurrence_residual = report.true_residual;
    report.is_converged = report.true_residual <= std::max(tolerance, 1e-8);
    return report;
  }

private:
  algebra::MergedMatrix K_;
  DirectFactor factor_;
  Vector b_, x_;
  bool is_stale_ = true;
};

class KrylovSolver final : public LinearSolver {
public:
  KrylovSolver(const Teuchos::ParameterList& options, const algebra::BlockMatrix& K,
               const NamedOperators& operators)
      : options_{options.get<std::string>("method"), options.get<int>("max iterations"),
                 options.isParameter("restart") ? options.get<int>("restart") : 0},
        rule_(options.get<double>("refresh factor"), preconditioner_of(options).setup_cost),
        system_(preconditioner_of(options).make(options, K, operators)), b_(system_->map(), 1),
        x_(system_->map(), 1) {
    for (char& c : options_.method) c = static_cast<char>(std::toupper(c));
  }

  void matrix_changed() override { is_stale_ = true; }

  void prepare() override {
    system_->refresh_matrix();
    SolveReport unused;
    refresh(unused);
    is_stale_ = false;
  }

  SolveReport solve(const algebra::BlockVector& b, algebra::BlockVector& x,
                    double tolerance) override {
    SolveReport report;
    report.method = options_.method;
    report.tolerance = tolerance;
    system_->gather(b, b_);
    if (is_stale_) system_->refresh_matrix();
    if (is_stale_ && rule_.wants_new()) refresh(report);
    int iterations = iterate(report);
    if (!report.is_converged && is_old_) {
      refresh(report);
      iterations = iterate(report);
    }
    rule_.note(iterations, report.true_residual, report.is_converged);
    is_old_ = true;
    is_stale_ = false;
    system_->scatter(x_, x);
    report.levels = system_->levels();
    return report;
  }

private:
  void refresh(SolveReport& report) {
    const Stopwatch watch;
    rule_.renew();  // nothing to keep should the set-up fail
    system_->refresh_preconditioner();
    is_old_ = false;
    report.setup_seconds += watch.seconds();
  }

  /// Iterations of one attempt.
  int iterate(SolveReport& report) {
    const Stopwatch watch;
    x_.putScalar(0.0);
    KrylovOptions options = options_;
    // An old preconditioner that takes so much longer is not worth the cap of a fresh one.
    if (is_stale_ && is_old_)
      options.max_iterations =
          static_cast<int>(std::min<double>(options.max_iterations, rule_.cap(report.tolerance)));
    const auto K = Teuchos::rcp(new CountingOperator(system_->matrix()));
    const KrylovResult result =
        solve_krylov(options, K, system_->preconditioner(), b_, x_, report.tolerance);
    report.operator_applications += K->count();
    report.iterations += result.iterations;
    report.recurrence_residual = result.recurrence_residual;
    report.true_residual = relative_residual(*system_->matrix(), b_, x_);
    if (!std::isfinite(report.true_residual)) {  // a breakdown: keep the start
      x_.putScalar(0.0);
      report.true_residual = 1.0;
    }
    // The recurrence of a Krylov method may drift from the truth by round-off, not by more.
    report.is_converged = report.true_residual <= 2.0 * report.tolerance + 1e-14;
    report.solve_seconds += watch.seconds();
    return result.iterations;
  }

  KrylovOptions options_;
  RefreshRule rule_;
  std::unique_ptr<PreconditionedSystem> system_;
  MultiVector b_, x_;
  bool is_stale_ = true;
  bool is_old_ = false;  ///< the preconditioner has served a solve already
};

params::Table krylov_table(const SolverDefaults& defaults, bool has_restart) {
  params::Table table;
  add_preconditioner_keys(table, defaults);
  table.integer("max iterations", 200, params::between(1, 1e6), "cap on the iterations")
      .number(
          "refresh factor", 1.0, params::non_negative(), "1",
          "set up a new preconditioner when the iterations lost by keeping the old one are this "
          "times what a set-up costs, and at once where a solve with an old one gets nowhere; 0: "
          "a new one for each matrix");
  if (has_restart)
    table.integer("restart", 200, params::between(1, 1e6), "basis vectors between restarts");
  return table;
}

}  // namespace

params::Table linear_solver_table(const SolverDefaults& defaults) {
  params::Table table("Solves the linear systems of Newton's method.");
  table.variant("method", "gcr",
                {{"direct", params::Table("sparse LU on rank 0, for small systems")},
                 {"flexible gmres", krylov_table(defaults, true)},
                 {"gmres", krylov_table(defaults, true)},
                 {"gcr", krylov_table(defaults, true)},
                 {"bicgstab", krylov_table(defaults, false)},
                 {"tfqmr", krylov_table(defaults, false)},
                 {"fixed point", krylov_table(defaults, false)}},
                "sparse direct (Amesos2 KLU2), a Krylov method (Belos, GCR ours), or the "
                "preconditioner alone, again and again (fixed point)");
  return table;
}

std::unique_ptr<LinearSolver> make_linear_solver(const Teuchos::ParameterList& options,
                                                 const algebra::BlockMatrix& K,
                                                 const NamedOperators& operators) {
  if (options.get<std::string>("method") == "direct") return std::make_unique<DirectSolver>(K);
  return std::make_unique<KrylovSolver>(options, K, operators);
}

std::string describe_unconverged(const SolveReport& report) {
  std::ostringstream text;
  text << "the linear solver (" << report.method << ") reached a relative residual of "
       << report.true_residual << " instead of " << report.tolerance << " in " << report.iterations
       << " iterations";
  return text.str();
}

}  // namespace tunica::linear
