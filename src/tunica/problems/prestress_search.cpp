#include "tunica/problems/prestress_search.hpp"

#include <algorithm>
#include <cmath>
#include <sstream>

#include "tunica/assembly/gather.hpp"
#include "tunica/base/error.hpp"
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

std::vector<Vec3> with_ghosts(const std::vector<Vec3>& values, const fields::FieldMesh& mesh) {
  Vector owned(mesh.vector_map);
  fields::store(values, mesh, owned);
  return fields::ghosted_vectors(mesh, owned);
}

/// f(∇s) of each element, s on owned nodes.
template <class Function>
std::vector<Mat3> of_gradients(const std::vector<Vec3>& s, const fields::FieldMesh& mesh,
                               const Function& f) {
  // ∇s of an element between ranks takes s at ghosts, too.
  const std::vector<Vec3> all = with_ghosts(s, mesh);
  const assembly::ElementGeometry geometry(mesh, mesh.x);
  std::vector<Mat3> values(mesh.tets.size());
  for (std::size_t e = 0; e < values.size(); ++e)
    values[e] = f(kernels::gradient(geometry[e], assembly::gather(all, mesh.tets[e])));
  return values;
}

/// By halves and Taylor's series.
Mat3 exponential(const Mat3& A) {
  // exp(A) = exp(A/2ⁿ)^(2ⁿ) with |A|/2ⁿ ≤ ¼, where ten terms of the series leave some 10⁻¹⁴
  double size = 0.0;
  for (const Vec3& row : A) size += dot(row, row);
  int halves = 0;
  for (size = std::sqrt(size); size > 0.25; size *= 0.5) ++halves;
  const double scale = std::ldexp(1.0, -halves);
  Mat3 sum = identity(), term = identity();
  for (int k = 1; k <= 10; ++k) {
    term = A * term;
    for (Vec3& row : term) row = scale / k * row;
    for (int i = 0; i < 3; ++i) sum[i] += term[i];
  }
  for (; halves > 0; --halves) sum = sum * sum;
  return sum;
}

// G ← exp(sym ∇s) G: short steps are (I + ε) G, and long ones invert no element.
class ByGradient final : public PrestressMethod {
public:
  explicit ByGradient(const fields::FieldMesh& mesh) : mesh_(&mesh) {}

  std::vector<Mat3> prestretch_after(const std::vector<Vec3>& s,
                                     const std::vector<Mat3>& present) override {
    std::vector<Mat3> G = of_gradients(
        s, *mesh_, [](const Mat3& gradient) { return exponential(symmetric_part(gradient)); });
    for (std::size_t e = 0; e < present.size(); ++e) G[e] = G[e] * present[e];
    return G;
  }

private:
  const fields::FieldMesh* mesh_;
};

// X ← X − s,  G⁻¹ = ∂X/∂x = I − ∇e,  e = x − X
class ByShape final : public PrestressMethod {
public:
  explicit ByShape(const fields::FieldMesh& mesh) : mesh_(&mesh), kept_(mesh.n_owned) {}

  std::vector<Mat3> prestretch_after(const std::vector<Vec3>& s,
                                     const std::vector<Mat3>& /*present*/) override {
    next_ = kept_;
    for (std::size_t a = 0; a < next_.size(); ++a) next_[a] += s[a];
    return of_gradients(next_, *mesh_, [](const Mat3& gradient) {
      Mat3 inverse = identity();
      for (int i = 0; i < 3; ++i) inverse[i] += -1.0 * gradient[i];
      Mat3 G = adjugate(inverse);
      const double J = det(inverse);  // where it is not positive, det G is not
      for (Vec3& row : G) row = 1.0 / J * row;
      return G;
    });
  }
  void keep() override { kept_ = next_; }
  void begin_load() override { before_ = kept_; }
  void undo_load() override { kept_ = before_; }
  std::vector<Vec3> shape() const override { return kept_; }
  void start_from(const std::vector<Vec3>& shape) override { kept_ = shape; }

private:
  const fields::FieldMesh* mesh_;
  std::vector<Vec3> kept_, next_, before_;  ///< e on owned nodes [mm]
};

}  // namespace

PrestressSearch::PrestressSearch(const SolidSettings& settings, const SolidProblem& wall,
                                 const PrestressWatch& watch, const PrestressPoint& from)
    : options_(settings.prestress), wall_(&wall), watch_(&watch),
      balance_(settings, wall), found_{{}, algebra::BlockVector(wall.space())} {
  if (options_.is_by_shape)
    method_ = std::make_unique<ByShape>(wall.mesh());
  else
    method_ = std::make_unique<ByGradient>(wall.mesh());
  // A search that goes on: its prestretch and pressure are the wall's, its shape the method's.
  if (from.load > 0.0) {
    point_ = from;
    method_->start_from(from.shape);
    go_back_to({wall.field().prestretch(), wall.state()});
  }
  // goal = tolerance · r, r the radius of the vessel
  std::vector<int> surfaces;
  for (const std::string& name : options_.surfaces)
    surfaces.push_back(wall.mesh().surface_index(name));
  goal_ = options_.tolerance * surface_radius(wall.mesh(), surfaces);
}

// Loads λ from 0 to 1, and at each of them Newton's method in G and p, while d = 0:
//
//   run()        λ ← λ + Δλ
//   bear()       steps at one λ: a few on the way, at λ = 1 until max |s| is within the goal
//   improve()    K (δ, δp) = R(G, p; λ), s = −δ, and the part θ of the step that is taken
//   try_step()   G and p behind θ s, and |R_u| there
//
// An increment that fails, and not for its linear systems, is halved; the next is longer where one
// step was enough.

Result<Prestress> PrestressSearch::run() {
  const double first = 1.0 / options_.load_steps;
  if (point_.step == 0.0) point_.step = first;
  for (;;) {
    const double done = point_.load, raised = done + point_.step;
    const double load = raised > 1.0 - 1e-9 ? 1.0 : raised;
    const Prestress before{found_.prestretch, algebra::BlockVector(wall_->space())};
    algebra::BlockVector(before.state).assign(found_.state);
    method_->begin_load();
    ++point_.load_step;
    const Verdict verdict = bear(load);
    if (verdict.cause == Cause::none && load == 1.0) return std::move(found_);
    if (verdict.cause == Cause::none) {
      // The fewer steps this load has taken, the further off the next one may be.
      point_.step *= iterations_ == 1 ? 1.5 : iterations_ <= 3 ? 1.0 : 0.7;
      if (watch_->goes_on(point_, found_)) continue;
      return Result<Prestress>::failure(stopped);
    }
    // Down to a sixteenth of the first increment. A linear solver that fails, or steps that creep
    // at the whole load, end the search.
    const bool is_cut = verdict.cause == Cause::nonlinear && point_.step > first / 16.0;
    if (!is_cut) return Result<Prestress>::failure(failure(load, verdict));
    go_back_to(before);
    method_->undo_load();
    point_.load = done;
    point_.step *= 0.5;
  }
}

// G and p of the point, d = 0. They have been admissible before.
void PrestressSearch::go_back_to(const Prestress& point) {
  found_.prestretch = point.prestretch;
  found_.state["pressure"].assign(point.state["pressure"]);
  const Outcome outcome = balance_.wall().field().set_prestretch(point.prestretch);
  TUNICA_CHECK(outcome.is_success(), outcome.reason());
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
    if (load == 1.0 && !watch_->goes_on(point_, found_)) return {Cause::stopped, stopped};
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
  return {Cause::creeps, std::to_string(most) + " steps (\"max iterations\") are not enough"};
}

// A step is reported with the range of det G whether it was taken or not.
PrestressSearch::Verdict PrestressSearch::iterate(PrestressIteration& now) {
  stop_if_urgent(comm());
  const Stopwatch watch;
  const Verdict verdict = improve(now);
  note_prestretch(now);
  now.seconds = watch.seconds();
  now.reason = verdict.reason;
  watch_->report(now);
  return verdict;
}

// K (δ, δp) = R(G, p),   G ← G after −θ δ,   p ← p − θ δp,   with the first θ of 1, ½, ¼, ⅛ by
// which |R_u| falls
PrestressSearch::Verdict PrestressSearch::improve(PrestressIteration& now) {
  algebra::BlockVector R(wall_->space()), dx(wall_->space());
  Outcome begun = balance_.wall().field().set_prestretch(found_.prestretch);
  if (begun.is_success()) begun = balance_.residual(now.load, found_.state, R);
  if (begun.is_failure()) return {Cause::nonlinear, begun.reason()};
  // |R_u| before the step
  const double before = R["displacement"].norm2();
  const Result<int> solved = balance_.solve(R, dx);
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
  const Outcome back = balance_.wall().field().set_prestretch(found_.prestretch);
  TUNICA_CHECK(back.is_success(), back.reason());
  if (now.goal > 0.0 && now.moved <= now.goal) return {};  // nothing is left but round-off
  return {Cause::nonlinear, refusal_};
}

// Taken where |R_u(G, p)| is less than before; else G, p and what the method keeps stay.
bool PrestressSearch::try_step(const std::vector<Vec3>& s, const algebra::BlockVector& dx,
                               double part, double before, PrestressIteration& now) {
  algebra::BlockVector state(wall_->space()), R(wall_->space());
  state.assign(found_.state);
  state["pressure"].update(-part, dx["pressure"], 1.0);
  std::vector<Mat3> G = method_->prestretch_after(s, found_.prestretch);
  Outcome outcome = balance_.wall().field().set_prestretch(G);
  if (outcome.is_success()) outcome = balance_.residual(now.load, state, R);
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

std::string PrestressSearch::failure(double load, const Verdict& verdict) const {
  if (verdict.cause == Cause::stopped) return verdict.reason;
  const double pressure = options_.pressure;
  std::ostringstream text;
  text << "the prestress, at " << load * pressure << " of " << pressure << " kPa: ";
  if (verdict.cause == Cause::linear_solver)
    text << "the linear solver gives up, whatever the wall may bear: ";
  text << verdict.reason << ". ";
  if (global_max(comm(), found_.prestretch.empty() ? 0.0 : 1.0) > 0.0) text << most_stretched();
  text << (verdict.cause == Cause::linear_solver
               ? ". Use another preconditioner in Wall / Linear Solver, or method = direct"
           : verdict.cause == Cause::creeps
               ? ". Is it held firmly enough (support, clamped ends)? Or use a larger \"tolerance\""
               : ". Is the wall too soft or too thin there for the pressure, or an element bad?");
  return text.str();
}

}  // namespace tunica::problems
