#include "tunica/linear/solvers/krylov_solver.hpp"

#include <algorithm>
#include <cctype>
#include <cmath>

#include "tunica/base/timer.hpp"
#include "tunica/base/traffic.hpp"
#include "tunica/io/progress.hpp"
#include "tunica/linear/counting_operator.hpp"
#include "tunica/linear/solvers/relative_residual.hpp"

namespace tunica::linear {

namespace {

/// The recurrence of a Krylov method may drift from the truth by round-off, not by more.
bool is_solved(double true_residual, double tolerance) {
  return true_residual <= 2.0 * tolerance + 1e-14;
}

/// Whether r of GCR is b − K x but for the rounding of a product. r = b − Σ_k α_k K z_k of one or
/// two directions of this very solve, whose images were just computed, is what a product with
/// x = Σ_k α_k z_k would give. The rounding of products does not count down to this tolerance.
constexpr double well_above_rounding = 1e-6;

/// Of a solve whose preconditioner a set-up may make better, and then takes few iterations more.
const StagnationRule patience_for_better{8, 0.1, 4.0};

/// Relative residual to which A Z = W is solved where K = A + W S Vᵀ has a part of low rank.
constexpr double accuracy_of_Z = 0.4;

/// Z helps, but no solve depends on it: where a preconditioner does not get there, what has been
/// reached is taken.
const StagnationRule patience_for_Z{10, 0.7, 10.0};

bool is_true(const KrylovResult& result, double tolerance) {
  return result.iterations <= 2 && tolerance >= well_above_rounding &&
         result.recurrence_residual <= tolerance;
}

}  // namespace

KrylovSolver::KrylovSolver(const Teuchos::ParameterList& options, const algebra::BlockMatrix& K,
                           const NamedOperators& operators)
    : space_(K.space()), preconditioner_(options.get<std::string>("preconditioner")),
      options_{options.get<std::string>("method"), options.get<int>("max iterations"),
               options.isParameter("restart") ? options.get<int>("restart") : 0},
      rule_(options.get<double>("refresh factor"), preconditioner_of(options).setup_cost),
      system_(preconditioner_of(options).make(options, K, operators)),
      augmented_(
          K, system_->matrix(),
          [this](const algebra::BlockVector& x, MultiVector& all) { system_->gather(x, all); },
          [this](const MultiVector& all, algebra::BlockVector& x) { system_->scatter(all, x); }),
      b_(system_->map(), 1), x_(system_->map(), 1) {
  if (options.isParameter("recycle")) options_.most_recycled = options.get<int>("recycle");
  if (options.isParameter(give_up_at) && options.get<int>(give_up_at) > 0)
    *stagnation_ = {20, 0.1, static_cast<double>(options.get<int>(give_up_at))};
  if (options_.most_recycled > 0) options_.recycled = Teuchos::rcp(new Directions);
  for (char& c : options_.method) c = static_cast<char>(std::toupper(c));
}

void KrylovSolver::prepare() {
  refresh_matrix();
  SolveReport unused;
  refresh(unused);
}

std::vector<algebra::BlockVector> KrylovSolver::save_vectors() const {
  std::vector<algebra::BlockVector> vectors;
  for (const Vector& z : augmented_.solutions()) system_->scatter(z, vectors.emplace_back(space_));
  return vectors;
}

void KrylovSolver::restore_vectors(const std::vector<algebra::BlockVector>& vectors) {
  std::vector<Vector> Z;
  for (const algebra::BlockVector& x : vectors) system_->gather(x, Z.emplace_back(system_->map()));
  augmented_.set_solutions(std::move(Z));
}

void KrylovSolver::forget() {
  rule_.renew();  // so that the next solve sets up, which drops the directions, too
  is_behind_ = true;
}

// With the present preconditioner, if the rule lets it serve; where an old one does not finish, or
// a new one that a set-up would make better, with a new one.
SolveReport KrylovSolver::solve(const algebra::BlockVector& b, algebra::BlockVector& x,
                                double tolerance) {
  SolveReport report;
  report.method = options_.method;
  report.preconditioner = preconditioner_;
  report.tolerance = tolerance;
  system_->gather(b, b_);
  if (is_stale_) refresh_matrix();
  if (is_behind_ && rule_.wants_new()) refresh(report);
  x_.putScalar(0.0);
  int iterations = iterate(report, true);
  double start = 1.0;  // |b − K x| / |b|
  const auto try_again = [&](bool with_new) {
    // GCR's residual never grows, and it goes on from there; methods of Belos reduce what they
    // find.
    if (options_.method == "GCR")
      start = report.true_residual;
    else
      x_.putScalar(0.0);
    if (with_new) refresh(report);
    iterations = iterate(report, with_new);
  };
  if (!report.is_converged && is_behind_) try_again(true);
  // The reduction is that of the last attempt, which has begun at this residual.
  const bool is_better = system_->note(iterations, report.true_residual / start);
  const bool was_hasty = report.has_stagnated && system_->may_improve() && !is_better;
  if (!report.is_converged && (is_better || was_hasty)) {
    try_again(is_better);
    system_->note(iterations, report.true_residual / start);
  }
  rule_.note(iterations, report.true_residual / start, report.is_converged);
  system_->scatter(x_, x);
  report.levels = system_->levels();
  return report;
}

// Recycled images Q = K Z are those of the old matrix.
void KrylovSolver::refresh_matrix() {
  system_->refresh_matrix();
  augmented_.refresh_matrix();
  if (recycles()) options_.recycled->clear();
  is_stale_ = false;
  is_behind_ = true;
}

void KrylovSolver::refresh(SolveReport& report) {
  const Stopwatch watch;
  const TrafficScope scope(Work::preconditioner);
  io::report_progress([this] { return "setting up the preconditioner " + preconditioner_; });
  rule_.renew();                               // nothing to keep should the set-up fail
  if (recycles()) options_.recycled->clear();  // it is measured without their help
  system_->refresh_preconditioner();
  // With Z to 0.4 the iterations are those of the blocks alone but for a few in a hundred.
  const Teuchos::RCP<const Operator> inverse = system_->preconditioner();
  if (!inverse.is_null())
    augmented_.refresh_inverse(inverse, [this](const Vector& w, Vector& z) { solve_blocks(w, z); });
  is_behind_ = false;
  report.setup_seconds += watch.seconds();
}

// A changes little from step to step: z of the last one, times the α of the least |w − α A z|,
// needs one iteration or none. On an arch with four outlets 15 steps up to systole take 70, from
// zeros 134; to 0.1 they take 118, for 9 fewer in the solves.
void KrylovSolver::solve_blocks(const Vector& w, Vector& z) {
  Vector r(w.getMap()), dz(w.getMap());
  system_->matrix()->apply(z, r);
  const double length = r.norm2(), alpha = r.dot(w) / (length * length);
  if (std::isfinite(alpha)) {
    z.scale(alpha);
    r.update(1.0, w, -alpha);  // r = w − α A z
  } else {
    z.putScalar(0.0);
    r.assign(w);
  }
  // A dz = r, so far that |w − A (z + dz)| is small against |w|
  const double tolerance = accuracy_of_Z * w.norm2() / r.norm2();
  if (tolerance >= 1.0) return;
  KrylovOptions gcr{"GCR", options_.max_iterations, options_.max_iterations};
  gcr.stagnation = Teuchos::rcp(new StagnationRule(patience_for_Z));
  solve_krylov(gcr, system_->matrix(), system_->preconditioner(), r, dz, tolerance);
  z.update(1.0, dz, 1.0);
}

// Where the part of low rank outweighs the blocks, products are inexact, images of recycled
// directions are not what they were, or a right-hand side is small against the rounding of K x, a
// method may take for solved what is not: what remains is solved for again.
void KrylovSolver::refine(KrylovOptions options, const Teuchos::RCP<const Operator>& K,
                          SolveReport& report) {
  options.recycled = Teuchos::null;
  options.stagnation = Teuchos::null;
  MultiVector r(b_.getMap(), 1), dx(b_.getMap(), 1);
  for (int pass = 0; pass < 2; ++pass) {
    const double rest = report.true_residual;
    if (is_solved(rest, report.tolerance) || !std::isfinite(rest)) return;
    if (!augmented_.has_low_rank() && recycles()) options_.recycled->clear();
    K->apply(x_, r);
    r.update(1.0, b_, -1.0);  // r = b − K x
    dx.putScalar(0.0);
    // K dx = r to τ |b|/|r|, so that |b − K (x + dx)| comes to τ |b|
    report.iterations +=
        solve_krylov(options, K, preconditioner(), r, dx, report.tolerance / rest).iterations;
    x_.update(1.0, dx, 1.0);
    report.true_residual = relative_residual(*K, b_, x_);
  }
}

// One attempt. An old preconditioner ends where a new one would be faster, a new one where one that
// a set-up makes better would (may_wait), or the next of the chain.
int KrylovSolver::iterate(SolveReport& report, bool may_wait) {
  const Stopwatch watch;
  const TrafficScope scope(Work::solve);
  KrylovOptions options = options_;
  // An old preconditioner that takes so much longer is not worth the cap of a fresh one.
  if (is_behind_) {
    options.max_iterations =
        static_cast<int>(std::min<double>(options.max_iterations, rule_.cap(report.tolerance)));
    options.stagnation = Teuchos::rcp(new StagnationRule(rule_.when_to_give_up()));
  } else if (may_wait && system_->may_improve()) {
    options.stagnation = Teuchos::rcp(new StagnationRule(patience_for_better));
  } else {
    options.stagnation = stagnation_;
  }
  const auto K = Teuchos::rcp(new CountingOperator(augmented_.matrix()));
  const bool is_by_itself =
      options.method == "GCR" && !(recycles() && options.recycled->size() > 0);
  const KrylovResult result = solve_krylov(options, K, preconditioner(), b_, x_, report.tolerance);
  const int before = report.iterations;
  report.iterations += result.iterations;
  report.recurrence_residual = result.recurrence_residual;
  report.has_stagnated = result.has_stagnated;
  report.true_residual = is_by_itself && is_true(result, report.tolerance)
                             ? result.recurrence_residual
                             : relative_residual(*augmented_.matrix(), b_, x_);
  // Where the method itself has not got there, its cap or its rule has ended it.
  if (result.recurrence_residual <= report.tolerance) refine(options, K, report);
  report.operator_applications += K->count();
  if (!std::isfinite(report.true_residual)) {  // a breakdown: keep the start
    x_.putScalar(0.0);
    report.true_residual = 1.0;
  }
  report.is_converged = is_solved(report.true_residual, report.tolerance);
  report.solve_seconds += watch.seconds();
  return report.iterations - before;
}

}  // namespace tunica::linear
