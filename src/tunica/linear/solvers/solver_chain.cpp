#include "tunica/linear/solvers/solver_chain.hpp"

#include <algorithm>
#include <sstream>

#include "tunica/base/told_apart.hpp"
#include "tunica/io/progress.hpp"
#include "tunica/linear/setup_failure.hpp"
#include "tunica/linear/solvers/fallbacks.hpp"

namespace tunica::linear {

namespace {

/// Steps without a new trial of the first preconditioner, at most.
constexpr int most_patience = 64;

/// What a preconditioner takes, its set-up and a solve, in iterations of the one before it. On
/// walls of 90,000 and 107,000 unknowns Vanka's multigrid needed 45 and 90 iterations, each as long
/// as 1.5 of the default, and factors as long as 220 and 290.
constexpr double cost_of_multigrid = 200.0, cost_of_factors = 400.0;

std::string why_given_up(const SolveReport& report) {
  const auto [found, wanted] = told_apart(report.true_residual, report.tolerance, 2);
  return std::string(report.has_stagnated ? "stagnates" : "ends") + " at a relative residual of " +
         found + " instead of " + wanted + " after " + std::to_string(report.iterations) +
         " iterations";
}

std::string gigabytes(double bytes) {
  std::ostringstream text;
  text.precision(2);
  text << bytes / 1e9 << " GB";
  return text.str();
}

}  // namespace

SolverChain::SolverChain(const Teuchos::ParameterList& options, const algebra::BlockMatrix& K,
                         const NamedOperators& operators)
    : most_factor_bytes_(1e9 * options.get<double>("direct memory")) {
  links_.push_back({options.get<std::string>("preconditioner"), {}, {}});
  links_.front().solver = std::make_unique<KrylovSolver>(options, K, operators);
  // Of further links only how to make them; one that is too large gives its reason when its turn
  // comes.
  for (const Fallback& fallback : fallbacks_of(options)) {
    Link link{fallback.name,
              [list = fallback.list, &K, &operators] {
                return std::make_unique<KrylovSolver>(list, K, operators);
              },
              {}};
    link.has_size_limit = fallback.name == direct_fallback;
    const int most = options.get<int>("direct unknowns");
    if (link.has_size_limit && K.n_unknowns() > most)
      link.refusal = "the system has " + std::to_string(K.n_unknowns()) +
                     " unknowns, \"direct unknowns\" are " + std::to_string(most);
    links_.push_back(std::move(link));
  }
}

// Hierarchies and factors take memory: a link is made when its turn comes.
KrylovSolver& SolverChain::present() {
  Link& link = links_[present_];
  if (!link.solver) link.solver = link.make();
  return *link.solver;
}

// r_k > 0.1 r_{k−30} with more iterations to come than the next link costs. The last one that may
// serve has no rule, and goes on to its cap.
StagnationRule SolverChain::rule() const {
  const auto next = std::find_if(links_.begin() + present_ + 1, links_.end(),
                                 [](const Link& link) { return link.refusal.empty(); });
  if (next == links_.end()) return {};
  return {30, 0.1, next->has_size_limit ? cost_of_factors : cost_of_multigrid};
}

// An order of elimination foretells the size of factors before they are made.
void SolverChain::check_size(Link& link) {
  if (!link.has_size_limit || link.solver) return;
  link.solver = link.make();
  const double bytes = link.solver->expected_bytes();
  if (bytes <= most_factor_bytes_) return;
  link.refusal = "its factors would take " + gigabytes(bytes) + ", \"direct memory\" is " +
                 gigabytes(most_factor_bytes_);
  link.solver.reset();
}

// Links that cannot serve are passed over, each with a word the first time. The successor stays for
// 1, 2, 4, … 64 steps, twice as many each time that the first link has failed anew.
bool SolverChain::take_next(const std::string& why) {
  for (std::size_t next = present_ + 1; next < links_.size(); ++next) {
    Link& link = links_[next];
    if (link.refusal.empty()) check_size(link);
    std::string words = "the preconditioner \"" + links_[present_].name + "\" " + why + "; ";
    words += link.refusal.empty() ? "\"" + link.name + "\" takes its place"
                                  : "\"" + link.name + "\" cannot take its place: " + link.refusal;
    if (!link.is_told) io::announce(words);
    link.is_told = true;
    if (!link.refusal.empty()) continue;
    if (present_ == 0) patience_ = std::clamp(2 * patience_, 1, most_patience);
    steps_held_ = patience_;
    present_ = next;
    return true;
  }
  return false;
}

void SolverChain::matrix_changed() {
  for (const Link& link : links_)
    if (link.solver) link.solver->matrix_changed();
}

void SolverChain::prepare() { present().prepare(); }

// Where a step begins. A successor counts down to the trial of the first link; that one, once it
// has served a whole step, starts the count from the beginning.
void SolverChain::forget() {
  for (const Link& link : links_)
    if (link.solver) link.solver->forget();
  if (present_ == 0)
    patience_ = 0;  // the first one has served a whole step
  else if (steps_held_-- <= 0)
    present_ = 0;
}

// The present link, then what it has learnt itself.
std::vector<double> SolverChain::save() const {
  const auto& solver = links_[present_].solver;
  const std::vector<double> learnt = solver ? solver->save() : std::vector<double>();
  if (present_ == 0 && patience_ == 0 && learnt.empty()) return {};
  std::vector<double> numbers = {static_cast<double>(present_), static_cast<double>(steps_held_),
                                 static_cast<double>(patience_)};
  numbers.insert(numbers.end(), learnt.begin(), learnt.end());
  return numbers;
}

void SolverChain::restore(const std::vector<double>& numbers) {
  present_ = numbers.empty() ? 0 : static_cast<std::size_t>(numbers.at(0));
  steps_held_ = numbers.empty() ? 0 : static_cast<int>(numbers.at(1));
  patience_ = numbers.empty() ? 0 : static_cast<int>(numbers.at(2));
  if (present_ >= links_.size()) present_ = 0;  // of a case with a longer list
  if (numbers.size() > 3) present().restore({numbers.begin() + 3, numbers.end()});
}

std::vector<algebra::BlockVector> SolverChain::save_vectors() const {
  const auto& solver = links_[present_].solver;
  return solver ? solver->save_vectors() : std::vector<algebra::BlockVector>();
}

void SolverChain::restore_vectors(const std::vector<algebra::BlockVector>& vectors) {
  if (!vectors.empty() || links_[present_].solver) present().restore_vectors(vectors);
}

SolveReport SolverChain::try_present(const algebra::BlockVector& b, algebra::BlockVector& x,
                                     double tolerance) {
  present().give_up_by(rule());
  SolveReport report = present().solve(b, x, tolerance);
  report.preconditioner = links_[present_].name;
  return report;
}

// Each link solves from zero. The answer is that of the last one, the cost that of all.
SolveReport SolverChain::solve(const algebra::BlockVector& b, algebra::BlockVector& x,
                               double tolerance) {
  std::vector<SolveReport> attempts;
  for (bool is_over = false; !is_over;) {
    try {
      attempts.push_back(try_present(b, x, tolerance));
      const SolveReport& last = attempts.back();
      is_over = last.is_converged ||
                (!take_next(why_given_up(last)) && !last.has_stagnated);  // else to its cap
    } catch (const SetupFailure& failure) {
      if (!take_next("fails: " + std::string(failure.what()))) throw;
    }
  }
  if (attempts.size() == 1) return attempts.front();
  SolveReport all = attempts.back();
  all.iterations = all.operator_applications = 0;
  all.setup_seconds = all.solve_seconds = 0.0;
  for (const SolveReport& one : attempts) add_costs(one, all);
  all.attempts = std::move(attempts);
  return all;
}

}  // namespace tunica::linear
