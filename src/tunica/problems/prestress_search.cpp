#include "tunica/problems/prestress_search.hpp"

#include <algorithm>
#include <cmath>
#include <sstream>

#include "tunica/base/error.hpp"
#include "tunica/base/formatted.hpp"
#include "tunica/base/reduce.hpp"
#include "tunica/base/stop_signals.hpp"
#include "tunica/base/timer.hpp"
#include "tunica/discretisation/inverted_element.hpp"
#include "tunica/kernels/deformation.hpp"
#include "tunica/kernels/wall_stress.hpp"
#include "tunica/problems/surface_radius.hpp"

namespace tunica::problems {

namespace {

constexpr const char* stopped = "stopped";  ///< the reason of a search that was to end

double largest(const std::vector<Vec3>& values, const Comm& comm) {
  double mine = 0.0;
  for (const Vec3& v : values) mine = std::max(mine, norm(v));
  return global_max(comm, mine);
}

}  // namespace

PrestressSearch::PrestressSearch(const SolidSettings& settings, const SolidProblem& wall,
                                 const PrestressWatch& watch, const PrestressPoint& from)
    : options_(settings.prestress), settings_(&settings), wall_(&wall),
      watch_(&watch), found_{{}, algebra::BlockVector(wall.space())} {
  method_ = make_prestress_method(options_.is_by_shape, wall.mesh());
  // A search that goes on: its prestretch, pressure and springs are the wall's, its shape the
  // method's. What has come so far may not be what the settings want now.
  point_.load_step = from.load_step;
  const bool is_wanted = (!from.leans || options_.may_lean) &&
                         (!options_.is_by_shape ||
                          all_agree(comm(), from.shape.size() == std::size_t(wall.mesh().n_owned)));
  const bool goes_on = from.load > 0.0 && is_wanted;
  balance_ = std::make_unique<PrestressBalance>(settings, wall, goes_on && from.leans);
  if (goes_on) {
    point_ = from;
    method_->start_from(from.shape);
    go_back_to({wall.field().prestretch(), wall.state(), wall.field().spring_offset()});
  }
  // goal = tolerance · r, r the radius of the vessel
  std::vector<int> surfaces;
  for (const std::string& name : options_.surfaces)
    surfaces.push_back(wall.mesh().surface_index(name));
  goal_ = options_.tolerance * surface_radius(wall.mesh(), surfaces);
}

// Loads λ from 0 to 1, and at each of them Newton's method in G and p, while d = 0:
//
//   raise_loads()  λ ← λ + Δλ
//   bear()         steps at one λ: a few on the way, at λ = 1 until max |s| is within the goal
//   improve()      K (δ, δp) = R(G, p; λ), s = −δ, and the part θ of the step that is taken
//   try_step()     G and p behind θ s, and |R_u| there
//
// An increment that fails, and not for its linear systems, is halved; the next is longer where one
// step was enough. Where the wall by itself cannot bear the loads it leans on the tissue, whose
// springs have a stretch o in the mesh:
//
//   lean()         o = 0, springs with all of k in K and in R; try_step(): o ← o + θ s
//   release()      at λ = 1: o ← o/4 and steps to the goal, as long as it is worth it

Result<Prestress> PrestressSearch::run() {
  // Searches that were stopped in a release are in balance.
  Verdict verdict = point_.releases > 0 ? Verdict{} : raise_loads();
  if (may_lean(verdict)) verdict = lean(verdict);
  if (verdict.cause == Cause::none && point_.leans) verdict = release();
  if (verdict.cause == Cause::none) return std::move(found_);
  return Result<Prestress>::failure(failure(verdict));
}

PrestressSearch::Verdict PrestressSearch::raise_loads() {
  const double first = 1.0 / options_.load_steps;
  // A sixteenth of the first increment; a quarter where there is tissue to lean on.
  const double least = can_lean() ? first / 4.0 : first / 16.0;
  if (point_.step == 0.0) point_.step = first;
  for (;;) {
    const double done = point_.load;
    point_.step = std::min(point_.step, 1.0 - done);
    const double raised = done + point_.step, load = raised > 1.0 - 1e-9 ? 1.0 : raised;
    const Prestress before = copy_of(found_);
    method_->begin_load();
    ++point_.load_step;
    Verdict verdict = bear(load);
    verdict.load = load;
    if (verdict.cause == Cause::none && load == 1.0) return verdict;
    if (verdict.cause == Cause::none) {
      // The fewer steps this load has taken, the further off the next one may be.
      point_.step *= iterations_ == 1 ? 1.5 : iterations_ <= 3 ? 1.0 : 0.7;
      if (goes_on()) continue;
      return {Cause::stopped, stopped, load};
    }
    // A linear solver that fails, or steps that creep at the whole load, end the search.
    const bool is_cut = verdict.cause == Cause::nonlinear && point_.step > least;
    if (!is_cut) return verdict;
    go_back_to(before);
    method_->undo_load();
    point_.load = done;
    point_.step *= 0.5;
  }
}

bool PrestressSearch::can_lean() const {
  return options_.may_lean && !options_.is_by_shape && !point_.leans &&
         has_springs(settings_->options.conditions);
}

// A linear solver that fails, or a cap that is too low, says nothing of the wall.
bool PrestressSearch::may_lean(const Verdict& verdict) const {
  const bool is_of_wall = verdict.cause == Cause::nonlinear || verdict.cause == Cause::creeps;
  return is_of_wall && can_lean();
}

// A wall that creeps at the whole load is nearly in balance, and goes on from there. One that bears
// no more is far off, and begins anew, as does one that cannot go on.
PrestressSearch::Verdict PrestressSearch::lean(const Verdict& verdict) {
  const std::string load =
      verdict.load == 1.0 ? "all" : formatted("%.3g", verdict.load);  // of the load
  watch_->say("the wall alone does not bear " + load + " of the load (" + verdict.reason +
              "): the tissue around it holds the rest");
  if (verdict.cause == Cause::creeps) {
    begin_to_lean(copy_of(found_), point_.load);
    const Verdict leaning = raise_loads();
    if (leaning.cause != Cause::nonlinear) return leaning;
  }
  begin_to_lean({{}, algebra::BlockVector(wall_->space())}, 0.0);
  return raise_loads();
}

void PrestressSearch::begin_to_lean(const Prestress& start, double load) {
  point_.leans = true;
  point_.step = 0.0;
  point_.load = load;
  balance_ = std::make_unique<PrestressBalance>(*settings_, *wall_, true);
  Prestress relaxed = copy_of(start);
  relaxed.offset.assign(wall_->mesh().n_nodes(), Vec3{});
  go_back_to(relaxed);
}

/// What is left of the stretch of springs that are released, and where that was too much at once;
/// how far a release must bring down what they hold for another one; and how many there may be.
constexpr double left_at_first = 0.25, left_then = 0.625, worthwhile = 0.8;
constexpr int most_releases = 10;

// o ← o/4, and steps until all is in balance: of what springs of stiffness k let go, a wall of
// stiffness K takes over K/(K + k). The last state in balance is the answer.
PrestressSearch::Verdict PrestressSearch::release() {
  std::string last_reason;
  for (int k = std::max(0, point_.releases - 1); k < most_releases; ++k) {
    const double held = held_by_tissue().mean;
    point_.releases = k + 1;
    balanced_ = {copy_of(found_), point_};
    Verdict verdict = release_once(left_at_first);
    if (verdict.cause == Cause::nonlinear) verdict = release_once(left_then);
    if (verdict.cause == Cause::stopped) return verdict;
    last_reason = verdict.reason;
    if (verdict.cause != Cause::none || held_by_tissue().mean > worthwhile * held) break;
  }
  balanced_.reset();
  if (!last_reason.empty()) {
    ++point_.load_step;
    const Verdict answer = bear(1.0);  // within the goal at once: the row of the answer
    if (answer.cause != Cause::none) return answer;
  }
  const TissueHold hold = held_by_tissue();
  watch_->say(formatted("the tissue holds %.3g kPa (root mean square), at most %.3g kPa at "
                        "(%.3g, %.3g, %.3g)",
                        hold.mean, hold.most, hold.at[0], hold.at[1], hold.at[2]) +
              (last_reason.empty() ? "" : "; less was not found: " + last_reason));
  return {};
}

// From the balanced state, and back to it where it fails.
PrestressSearch::Verdict PrestressSearch::release_once(double left) {
  for (Vec3& o : found_.offset) o = left * o;
  ++point_.load_step;
  const Verdict verdict = bear(1.0);
  if (verdict.cause != Cause::none && verdict.cause != Cause::stopped) go_back_to(balanced_->state);
  return verdict;
}

bool PrestressSearch::goes_on() const {
  return balanced_ ? watch_->goes_on(balanced_->point, balanced_->state)
                   : watch_->goes_on(point_, found_);
}

TissueHold PrestressSearch::held_by_tissue() const {
  return tissue_hold(settings_->options.conditions, wall_->mesh(), found_.offset);
}

Outcome PrestressSearch::put(const std::vector<Mat3>& prestretch, const std::vector<Vec3>& offset) {
  balance_->wall().field().set_spring_offset(offset);
  return balance_->wall().field().set_prestretch(prestretch);
}

// G, p and o of the point, d = 0. They have been admissible before.
void PrestressSearch::go_back_to(const Prestress& point) {
  found_.prestretch = point.prestretch;
  found_.offset = point.offset;
  found_.state["pressure"].assign(point.state["pressure"]);
  const Outcome outcome = put(point.prestretch, point.offset);
  TUNICA_CHECK(outcome.is_success(), outcome.reason());
}

Prestress PrestressSearch::copy_of(const Prestress& point) const {
  Prestress copy{point.prestretch, algebra::BlockVector(wall_->space()), point.offset};
  copy.state.assign(point.state);
  return copy;
}

/// Steps in which what is left must have halved.
constexpr int patience = 10;
/// At most so many at a load that is not all of it.
constexpr int most_on_the_way = 4;

PrestressSearch::Verdict PrestressSearch::bear(double load) {
  const int most = load < 1.0 ? most_on_the_way : options_.max_iterations;
  std::vector<double> history;  // of what is left
  for (int k = 1; k <= most; ++k) {
    PrestressIteration now{};
    now.load_step = point_.load_step;
    now.iteration = iterations_ = k;
    now.load = load;
    now.goal = load == 1.0 ? goal_ : 0.0;
    const Verdict verdict = iterate(now);
    if (verdict.cause != Cause::none) return verdict;
    point_.load = load;
    point_.shape = method_->shape();
    if (load == 1.0 && !goes_on()) return {Cause::stopped, stopped};
    history.push_back(now.moved);
    // On the way the next load may come where the step has left less than 0.3 of the residual, or
    // is shorter than a fifth of the first one.
    const bool is_on_its_way = now.residual < 0.3 || now.moved < 0.2 * history.front();
    if (load < 1.0 && k == most && now.moved > 0.5 * history.front())
      return {Cause::nonlinear,
              "steps do not get shorter than " + std::to_string(now.moved) + " mm"};
    if (load < 1.0 ? is_on_its_way || k == most : now.moved <= now.goal) return {};
    // Ten steps that do not halve |s| creep, as where nothing but weak springs holds the wall.
    if (k > patience && now.moved > 0.5 * history[k - 1 - patience])
      return {Cause::creeps, "steps do not get shorter than " + std::to_string(now.moved) + " mm"};
  }
  return {Cause::cap, std::to_string(most) + " steps (\"max iterations\") are not enough"};
}

// A step is reported with the range of det G whether it was taken or not.
PrestressSearch::Verdict PrestressSearch::iterate(PrestressIteration& now) {
  stop_if_urgent(comm());
  const Stopwatch watch;
  const Verdict verdict = improve(now);
  note_prestretch(now);
  if (point_.leans) now.tissue = held_by_tissue();
  now.seconds = watch.seconds();
  now.reason = verdict.reason;
  watch_->report(now);
  return verdict;
}

// K (δ, δp) = R(G, p, o),   G ← G after −θ δ,   p ← p − θ δp,   o ← o − θ δ,   with the first θ of
// 1, ½, ¼, ⅛ by which |R_u| falls
PrestressSearch::Verdict PrestressSearch::improve(PrestressIteration& now) {
  algebra::BlockVector R(wall_->space()), dx(wall_->space());
  Outcome begun = put(found_.prestretch, found_.offset);
  if (begun.is_success()) begun = balance_->residual(now.load, found_.state, R);
  if (begun.is_failure()) return {Cause::nonlinear, begun.reason()};
  // |R_u| before the step
  const double before = R["displacement"].norm2();
  const Result<int> solved = balance_->solve(R, dx);
  if (solved.is_failure()) return {Cause::linear_solver, solved.reason()};
  now.linear = solved.value();
  std::vector<Vec3> step = fields::owned_vectors(wall_->mesh(), dx["displacement"]);
  for (Vec3& s : step) s = -1.0 * s;
  now.moved = largest(step, comm());
  for (double part = 1.0; part > 0.1; part *= 0.5) {
    std::vector<Vec3> shorter(step);
    for (Vec3& s : shorter) s = part * s;
    if (try_step(shorter, dx, part, before, now)) return {};
  }
  const Outcome back = put(found_.prestretch, found_.offset);
  TUNICA_CHECK(back.is_success(), back.reason());
  if (now.goal > 0.0 && now.moved <= now.goal) return {};  // nothing is left but round-off
  return {Cause::nonlinear, refusal_};
}

// Taken where |R_u(G, p, o)| is less than before; else G, p, o and what the method keeps stay.
bool PrestressSearch::try_step(const std::vector<Vec3>& s, const algebra::BlockVector& dx,
                               double part, double before, PrestressIteration& now) {
  algebra::BlockVector state(wall_->space()), R(wall_->space());
  state.assign(found_.state);
  state["pressure"].update(-part, dx["pressure"], 1.0);
  std::vector<Mat3> G = method_->prestretch_after(s, found_.prestretch);
  std::vector<Vec3> offset = found_.offset;
  if (point_.leans) {
    const std::vector<Vec3> all = fields::ghosted_vectors(wall_->mesh(), s);
    for (std::size_t a = 0; a < offset.size(); ++a) offset[a] += all[a];
  }
  Outcome outcome = put(G, offset);
  if (outcome.is_success()) outcome = balance_->residual(now.load, state, R);
  if (outcome.is_failure()) {
    refusal_ = outcome.reason();
    return false;
  }
  now.residual = R["displacement"].norm2() / before;
  if (!(now.residual < 1.0)) {  // nor where it is not a number
    refusal_ = std::isfinite(now.residual) ? "no step reduces the imbalance"
                                           : "stresses exceed the range of the law";
    return false;
  }
  method_->keep();
  found_.prestretch = std::move(G);
  found_.offset = std::move(offset);
  found_.state.assign(state);
  return true;
}

// min_e det G, max_e det G
void PrestressSearch::note_prestretch(PrestressIteration& now) const {
  double least = 1.0, most = 1.0;
  for (std::size_t e = 0; e < found_.prestretch.size(); ++e) {
    const double J = det(found_.prestretch[e]);
    least = e == 0 ? J : std::min(least, J);
    most = e == 0 ? J : std::max(most, J);
  }
  now.least = global_min(comm(), least);
  now.most = global_max(comm(), most);
}

// max_e λ_1(GᵀG), by the least of −λ_1
std::string PrestressSearch::most_stretched() const {
  double most = 0.0;
  int element = -1;
  for (std::size_t e = 0; e < found_.prestretch.size(); ++e) {
    const double squared =
        kernels::principal_values(kernels::right_cauchy_green(found_.prestretch[e])).front();
    if (squared <= most) continue;
    most = squared;
    element = static_cast<int>(e);
  }
  const auto found = discretisation::least_element(wall_->mesh(), -most, element);
  std::ostringstream text;
  text << "Stretched most, by " << std::sqrt(-found.value) << ", is " << found.name;
  return text.str();
}

std::string PrestressSearch::failure(const Verdict& verdict) const {
  if (verdict.cause == Cause::stopped) return verdict.reason;
  const double pressure = options_.pressure;
  std::ostringstream text;
  text << "the prestress, at " << verdict.load * pressure << " of " << pressure << " kPa: ";
  if (verdict.cause == Cause::linear_solver)
    text << "the linear solver gives up, whatever the wall may bear: ";
  text << verdict.reason << ". ";
  if (global_max(comm(), found_.prestretch.empty() ? 0.0 : 1.0) > 0.0) text << most_stretched();
  text << (verdict.cause == Cause::linear_solver
               ? ". Use another preconditioner in Wall / Linear Solver, or method = direct"
           : verdict.cause == Cause::creeps
               ? ". Is it held firmly enough (support, clamped ends)? Or use a larger \"tolerance\""
           : verdict.cause == Cause::cap
               ? ". Permit more, or use a larger \"tolerance\""
               : ". Is the wall too soft or too thin there for the pressure, or an element bad?");
  return text.str();
}

}  // namespace tunica::problems
