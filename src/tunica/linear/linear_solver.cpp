#include "tunica/linear/linear_solver.hpp"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <sstream>

#include "tunica/algebra/merged_matrix.hpp"
#include "tunica/base/timer.hpp"
#include "tunica/base/traffic.hpp"
#include "tunica/linear/action_sum.hpp"
#include "tunica/linear/counting_operator.hpp"
#include "tunica/linear/direct_factor.hpp"
#include "tunica/linear/krylov.hpp"
#include "tunica/linear/low_rank.hpp"
#include "tunica/linear/refresh_rule.hpp"
#include "tunica/linear/setup_failure.hpp"

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
      : K_(K), factor_(K_.matrix()), b_(K_.matrix()->getRowMap()), x_(b_.getMap()) {
    const auto gather = [this](const algebra::BlockVector& x, MultiVector& all) {
      K_.merge(x, all);
    };
    if (K.low_rank()) take_low_rank(K, gather);
    if (K.action())
      whole_ = Teuchos::rcp(new ActionSum(
          matrix(), K, gather,
          [this](const MultiVector& all, algebra::BlockVector& x) { K_.split(all, x); }));
  }

  void matrix_changed() override { is_stale_ = true; }

  void prepare() override {
    K_.refresh();
    factor_.refresh();
    if (!sum_.is_null()) prepare_sum();
    is_stale_ = false;
  }

  void forget() override {}  // a matrix's own factors are all that there is

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
    report.iterations = 1;
    if (!whole_.is_null())
      report.iterations = solve_whole(tolerance);
    else if (sum_.is_null())
      factor_.apply(b_, x_);
    else
      solve_sum();
    K_.split(x_, x);
    report.solve_seconds = solving.seconds();
    report.true_residual = relative_residual(*matrix(), b_, x_);
    report.recurrence_residual = report.true_residual;
    const double enough = std::max(tolerance, 1e-8);
    report.is_converged = report.true_residual <= (whole_.is_null() ? enough : 2.0 * enough);
    return report;
  }

private:
  void take_low_rank(const algebra::BlockMatrix& K, const LowRankForm::Gather& gather) {
    const LowRankForm form(K, b_.getMap(), gather);
    sum_ = Teuchos::rcp(new LowRankSum(K_.matrix(), form));
    sum_inverse_ = Teuchos::rcp(new LowRankInverse(form));
  }

  void prepare_sum() {
    sum_->refresh();
    if (!sum_inverse_->refresh(Teuchos::rcpFromRef(factor_),
                               [this](const Vector& w, Vector& z) { factor_.apply(w, z); }))
      throw SetupFailure("the matrix is singular with what couples whole surfaces");
  }

  Teuchos::RCP<const Operator> matrix() const {
    if (!whole_.is_null()) return whole_;
    if (!sum_.is_null()) return sum_;
    return K_.matrix();
  }

  /// What has no entries is not in the factors. Iterations.
  int solve_whole(double tolerance) {
    const int most = 100;
    x_.putScalar(0.0);
    Teuchos::RCP<const Operator> inverse = Teuchos::rcpFromRef(factor_);
    if (!sum_inverse_.is_null()) inverse = sum_inverse_;
    return solve_krylov({"GCR", most, most}, whole_, inverse, b_, x_, tolerance).iterations;
  }

  /// The formula loses the digits by which the part of low rank outweighs the blocks; a step of
  /// iterative refinement brings them back.
  void solve_sum() {
    Vector r(b_.getMap()), dx(b_.getMap());
    sum_inverse_->apply(b_, x_);
    sum_->apply(x_, r);
    r.update(1.0, b_, -1.0);  // r = b − K x
    sum_inverse_->apply(r, dx);
    x_.update(1.0, dx, 1.0);
  }

  algebra::MergedMatrix K_;
  DirectFactor factor_;
  Vector b_, x_;
  bool is_stale_ = true;
  Teuchos::RCP<LowRankSum> sum_;  ///< both null where K has blocks only
  Teuchos::RCP<LowRankInverse> sum_inverse_;
  Teuchos::RCP<ActionSum> whole_;  ///< null where K has no part without entries
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
    if (options.isParameter("recycle")) options_.most_recycled = options.get<int>("recycle");
    if (options_.most_recycled > 0) options_.recycled = Teuchos::rcp(new Directions);
    for (char& c : options_.method) c = static_cast<char>(std::toupper(c));
    const PreconditionedSystem& system = *system_;
    const auto gather = [&system](const algebra::BlockVector& x, MultiVector& all) {
      system.gather(x, all);
    };
    if (K.low_rank()) take_low_rank(K, gather);
    if (K.action())
      whole_ = Teuchos::rcp(new ActionSum(
          matrix(), K, gather,
          [&system](const MultiVector& all, algebra::BlockVector& x) { system.scatter(all, x); }));
  }

  void matrix_changed() override { is_stale_ = true; }

  void prepare() override {
    refresh_matrix();
    SolveReport unused;
    refresh(unused);
  }

  void forget() override {
    rule_.renew();  // so that the next solve sets up, which drops the directions, too
    is_behind_ = true;
  }

  SolveReport solve(const algebra::BlockVector& b, algebra::BlockVector& x,
                    double tolerance) override {
    SolveReport report;
    report.method = options_.method;
    report.tolerance = tolerance;
    system_->gather(b, b_);
    if (is_stale_) refresh_matrix();
    if (is_behind_ && rule_.wants_new()) refresh(report);
    int iterations = iterate(report);
    if (!report.is_converged && is_behind_) {
      refresh(report);
      iterations = iterate(report);
    }
    rule_.note(iterations, report.true_residual, report.is_converged);
    system_->scatter(x_, x);
    report.levels = system_->levels();
    return report;
  }

private:
  void take_low_rank(const algebra::BlockMatrix& K, const LowRankForm::Gather& gather) {
    const LowRankForm form(K, system_->map(), gather);
    sum_ = Teuchos::rcp(new LowRankSum(system_->matrix(), form));
    sum_inverse_ = Teuchos::rcp(new LowRankInverse(form));
  }

  void refresh(SolveReport& report) {
    const Stopwatch watch;
    const TrafficScope scope(Work::preconditioner);
    rule_.renew();                               // nothing to keep should the set-up fail
    if (recycles()) options_.recycled->clear();  // it is measured without their help
    system_->refresh_preconditioner();
    if (has_sum_inverse()) refresh_sum_inverse();
    is_behind_ = false;
    report.setup_seconds += watch.seconds();
  }

  /// The recurrence of a Krylov method may drift from the truth by round-off, not by more.
  static bool is_solved(double true_residual, double tolerance) {
    return true_residual <= 2.0 * tolerance + 1e-14;
  }

  void refresh_matrix() {
    system_->refresh_matrix();
    if (!sum_.is_null()) sum_->refresh();
    if (recycles()) options_.recycled->clear();
    is_stale_ = false;
    is_behind_ = true;
  }

  bool recycles() const { return !options_.recycled.is_null(); }
  bool has_sum_inverse() const { return !sum_.is_null() && !system_->preconditioner().is_null(); }

  /// With Z this good the iterations are those of the blocks alone; a few make it so.
  void refresh_sum_inverse() {
    const KrylovOptions gcr{"GCR", options_.max_iterations, options_.max_iterations};
    sum_inverse_->refresh(system_->preconditioner(), [&](const Vector& w, Vector& z) {
      solve_krylov(gcr, system_->matrix(), system_->preconditioner(), w, z, 1e-2);
    });
  }

  Teuchos::RCP<const Operator> matrix() const {
    if (!whole_.is_null()) return whole_;
    if (sum_.is_null()) return system_->matrix();
    return sum_;
  }

  Teuchos::RCP<const Operator> preconditioner() const {
    if (has_sum_inverse()) return sum_inverse_;
    return system_->preconditioner();
  }

  /// Where the part of low rank outweighs the blocks, products are inexact, or images of recycled
  /// directions are not what they were, a method may take for solved what is not: what remains is
  /// solved for again.
  void refine(KrylovOptions options, const Teuchos::RCP<const Operator>& K, SolveReport& report) {
    options.recycled = Teuchos::null;
    MultiVector r(b_.getMap(), 1), dx(b_.getMap(), 1);
    for (int pass = 0; pass < 2; ++pass) {
      const double rest = report.true_residual;
      if (is_solved(rest, report.tolerance) || !std::isfinite(rest)) return;
      if (sum_.is_null() && recycles()) options_.recycled->clear();
      K->apply(x_, r);
      r.update(1.0, b_, -1.0);  // r = b − K x
      dx.putScalar(0.0);
      report.iterations +=
          solve_krylov(options, K, preconditioner(), r, dx, report.tolerance / rest).iterations;
      x_.update(1.0, dx, 1.0);
      report.true_residual = relative_residual(*K, b_, x_);
    }
  }

  /// Iterations of one attempt.
  int iterate(SolveReport& report) {
    const Stopwatch watch;
    const TrafficScope scope(Work::solve);
    x_.putScalar(0.0);
    KrylovOptions options = options_;
    // An old preconditioner that takes so much longer is not worth the cap of a fresh one.
    if (is_behind_)
      options.max_iterations =
          static_cast<int>(std::min<double>(options.max_iterations, rule_.cap(report.tolerance)));
    const auto K = Teuchos::rcp(new CountingOperator(matrix()));
    const KrylovResult result =
        solve_krylov(options, K, preconditioner(), b_, x_, report.tolerance);
    const int before = report.iterations;
    report.iterations += result.iterations;
    report.recurrence_residual = result.recurrence_residual;
    report.true_residual = relative_residual(*matrix(), b_, x_);
    const bool may_drift = !sum_.is_null() || !whole_.is_null() || recycles();
    if (may_drift && result.recurrence_residual <= report.tolerance) refine(options, K, report);
    report.operator_applications += K->count();
    if (!std::isfinite(report.true_residual)) {  // a breakdown: keep the start
      x_.putScalar(0.0);
      report.true_residual = 1.0;
    }
    report.is_converged = is_solved(report.true_residual, report.tolerance);
    report.solve_seconds += watch.seconds();
    return report.iterations - before;
  }

  KrylovOptions options_;
  RefreshRule rule_;
  std::unique_ptr<PreconditionedSystem> system_;
  Teuchos::RCP<LowRankSum> sum_;  ///< both null where K has blocks only
  Teuchos::RCP<LowRankInverse> sum_inverse_;
  Teuchos::RCP<ActionSum> whole_;  ///< null where K has no part without entries
  MultiVector b_, x_;
  bool is_stale_ = true;
  bool is_behind_ = false;  ///< the preconditioner is that of an earlier matrix
};

params::Table krylov_table(const SolverDefaults& defaults, bool has_restart,
                           bool has_recycling = false) {
  params::Table table;
  add_preconditioner_keys(table, defaults);
  table.integer("max iterations", 200, params::between(1, 1e6), "cap on the iterations")
      .number(
          "refresh factor", 1.0, params::non_negative(), "1",
          "within a time step, set up a new preconditioner when the iterations lost by keeping the "
          "old one are this times what a set-up costs, and at once where a solve with an old one "
          "gets nowhere; 0: a new one for each matrix");
  if (has_recycling)
    table.integer("recycle", defaults.recycled, params::between(0, 1000),
                  "search directions kept from one right side to the next of the same matrix; they "
                  "cost as much memory as twice as many vectors");
  if (has_restart)
    table.integer("restart", 200, params::between(1, 1e6), "basis vectors between restarts");
  return table;
}

}  // namespace

params::Table linear_solver_table(const SolverDefaults& defaults) {
  // Other methods take no preconditioner that solves within.
  SolverDefaults linear = defaults;
  linear.has_fields = false;
  params::Table table("Solves the linear systems of Newton's method.");
  table.variant("method", "gcr",
                {{"direct", params::Table("sparse LU on rank 0, for small systems")},
                 {"flexible gmres", krylov_table(defaults, true)},
                 {"gmres", krylov_table(linear, true)},
                 {"gcr", krylov_table(defaults, true, true)},
                 {"bicgstab", krylov_table(linear, false)},
                 {"tfqmr", krylov_table(linear, false)},
                 {"fixed point", krylov_table(defaults, false)}},
                "sparse direct (Amesos2 KLU2), a Krylov method (Belos, GCR ours), or the "
                "preconditioner alone, again and again (fixed point)");
  return table;
}

params::Table inner_solver_table(SolverDefaults defaults) {
  defaults.has_fields = false;
  defaults.recycled = 0;
  params::Table table("Solves for one field within a preconditioner.");
  table
      .variant("method", "gcr",
               {{"direct", params::Table("sparse LU on rank 0, for small systems")},
                {"gcr", krylov_table(defaults, true, true)},
                {"fixed point", krylov_table(defaults, false)}},
               "sparse direct (Amesos2 KLU2), GCR, or the preconditioner alone, as often as "
               "\"max iterations\" says (fixed point)")
      .number("tolerance", 0.1, params::Range{0.0, 1.0, false, true}, "1",
              "ends at this relative residual, or at \"max iterations\"");
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
