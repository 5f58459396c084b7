#include "tunica/problems/prestress_search.hpp"

#include <algorithm>
#include <cmath>
#include <sstream>

#include "tunica/algebra/least_squares.hpp"
#include "tunica/assembly/gather.hpp"
#include "tunica/base/error.hpp"
#include "tunica/base/reduce.hpp"
#include "tunica/base/timer.hpp"
#include "tunica/discretisation/inverted_element.hpp"
#include "tunica/kernels/deformation.hpp"
#include "tunica/kernels/wall_stress.hpp"
#include "tunica/problems/surface_radius.hpp"

namespace tunica::problems {

namespace {

std::vector<double> numbers(const std::vector<Vec3>& values) {
  std::vector<double> all;
  for (const Vec3& v : values) all.insert(all.end(), v.begin(), v.end());
  return all;
}

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

Mat3 product(const Mat3& A, const Mat3& B) {
  const Mat3 Bt = transpose(B);
  Mat3 C;
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j) C[i][j] = dot(A[i], Bt[j]);
  return C;
}

}  // namespace

std::vector<Vec3> StepAcceleration::step(const Comm& comm, const std::vector<Vec3>& left) {
  constexpr std::size_t most = 10;
  constexpr double filter = 0.05;  // equilibria are as accurate as that
  const std::vector<double> r = numbers(left);
  std::vector<double> s(r);
  if (!last_r_.empty()) {
    std::vector<double> change(r);
    for (std::size_t i = 0; i < r.size(); ++i) change[i] -= last_r_[i];
    of_r_.push_front(std::move(change));
    of_s_.push_front(last_s_);
  }
  if (of_r_.size() > most) {
    of_r_.pop_back();
    of_s_.pop_back();
  }
  const auto fit = algebra::solve_least_squares(comm, of_r_, r, filter);
  for (std::size_t j = 0; j < of_r_.size(); ++j)
    for (std::size_t i = 0; i < s.size(); ++i)
      s[i] -= fit.coefficients[j] * (of_s_[j][i] + of_r_[j][i]);
  last_r_ = r;
  last_s_ = s;
  std::vector<Vec3> step(left.size());
  for (std::size_t i = 0; i < s.size(); ++i) step[i / 3][i % 3] = s[i];
  return step;
}

namespace {

// G ← (J/det G')^⅓ G',   G' = (I + ∇s) G,   J = 1 − p̄/κ of the element
//
// The pressures keep the volume of patches, and elements of a patch may trade theirs: in one
// equilibrium as far as displacements of nodes can, but from step to step without bound, since
// stress depends on the isochoric part of F. Where each has the volume that belongs to its pressure
// they have nothing to trade.
class ByGradient final : public PrestressMethod {
public:
  ByGradient(const SolidProblem& wall, const Prestress& present)
      : wall_(&wall), present_(&present) {}

  std::vector<Mat3> prestretch_after(const std::vector<Vec3>& step) override {
    const fields::FieldMesh &mesh = wall_->mesh(), &scalar_mesh = wall_->scalar_mesh();
    const std::vector<Vec3> s = with_ghosts(step, mesh);
    const auto p = fields::ghosted_scalars(scalar_mesh, wall_->state()["pressure"]);
    const assembly::ElementGeometry geometry(mesh, mesh.x);
    std::vector<Mat3> G(mesh.tets.size());
    for (std::size_t e = 0; e < G.size(); ++e) {
      G[e] = kernels::deformation_gradient(geometry[e], assembly::gather(s, mesh.tets[e]));
      if (!present_->prestretch.empty()) G[e] = product(G[e], present_->prestretch[e]);
      const auto p_e = assembly::gather(p, scalar_mesh.tets[e]);
      const double inv_kappa = wall_->elements().layer(e).coefficients.inv_kappa;
      const double J = 1.0 - 0.25 * inv_kappa * (p_e[0] + p_e[1] + p_e[2] + p_e[3]);
      const double factor = std::cbrt(J / det(G[e]));  // negative where the element is inverted
      for (Vec3& row : G[e]) row = std::abs(factor) * row;
    }
    return G;
  }
  bool iterates_all_loads() const override { return false; }

private:
  const SolidProblem* wall_;  ///< in equilibrium
  const Prestress* present_;
};

// X ← X − s,  G⁻¹ = ∂X/∂x = I − ∇(x − X)
class ByShape final : public PrestressMethod {
public:
  explicit ByShape(const fields::FieldMesh& mesh) : mesh_(&mesh), kept_(mesh.n_owned) {}

  std::vector<Mat3> prestretch_after(const std::vector<Vec3>& step) override {
    next_ = kept_;
    for (std::size_t a = 0; a < next_.size(); ++a) next_[a] += step[a];
    const std::vector<Vec3> from_shape = with_ghosts(next_, *mesh_);
    const assembly::ElementGeometry geometry(*mesh_, mesh_->x);
    std::vector<Mat3> G(mesh_->tets.size());
    for (std::size_t e = 0; e < G.size(); ++e) {
      auto to_shape = assembly::gather(from_shape, mesh_->tets[e]);
      for (Vec3& d : to_shape) d = -1.0 * d;
      const Mat3 inverse = kernels::deformation_gradient(geometry[e], to_shape);
      const Mat3 adj = adjugate(inverse);
      const double J = det(inverse);  // where it is not positive, det G is not
      for (int i = 0; i < 3; ++i) G[e][i] = 1.0 / J * adj[i];
    }
    return G;
  }
  void keep() override { kept_ = next_; }
  void begin_load() override { before_ = kept_; }
  void undo_load() override { kept_ = before_; }
  bool iterates_all_loads() const override { return true; }

private:
  const fields::FieldMesh* mesh_;
  std::vector<Vec3> kept_, next_, before_;  ///< x − X on owned nodes [mm]
};

}  // namespace

PrestressSearch::PrestressSearch(const Teuchos::ParameterList& list, const SolidProblem& wall,
                                 const PrestressWatch& watch, const PrestressPoint& from)
    : options_(&list.sublist("Prestress")), wall_(&wall), watch_(&watch),
      equilibrium_(list, wall), found_{wall.prestretch(), algebra::BlockVector(wall.space())} {
  if (options_->get<std::string>("method") == "stress-free shape") {
    method_ = std::make_unique<ByShape>(wall.mesh());
    found_.prestretch.clear();  // says nothing of the shape
  } else {
    method_ = std::make_unique<ByGradient>(equilibrium_.wall(), found_);
    point_ = from;
  }
  if (point_.load > 0.0) go_back_to({wall.prestretch(), wall.state()});
  std::vector<int> surfaces;
  for (const std::string& name : prestress_surfaces(list))
    surfaces.push_back(wall.mesh().surface_index(name));
  goal_ = options_->get<double>("tolerance") * surface_radius(wall.mesh(), surfaces);
}

// A load that fails, and not for its linear systems, is halved, and raised in longer steps where
// its equilibria are found at once.

Result<Prestress> PrestressSearch::run() {
  const double first = 1.0 / options_->get<int>("load steps");
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
      point_.step *= newton_ <= 2 ? 1.5 : newton_ <= 4 ? 1.0 : 0.7;
      continue;
    }
    const bool is_cut = verdict.cause == Cause::nonlinear && point_.step > first / 512.0;
    if (!is_cut) return Result<Prestress>::failure(failure(load, verdict));
    go_back_to(before);
    method_->undo_load();
    point_.load = done;
    point_.step *= 0.5;
  }
}

void PrestressSearch::go_back_to(const Prestress& point) {
  found_.prestretch = point.prestretch;
  found_.state["pressure"].assign(point.state["pressure"]);
  const Outcome outcome = equilibrium_.wall().set_prestretch(point.prestretch);
  TUNICA_CHECK(outcome.is_success(), outcome.reason());
}

double PrestressSearch::goal(double load) const {
  if (load == 1.0) return goal_;
  return method_->iterates_all_loads() ? 10.0 * goal_ : 0.0;  // only where the next one begins
}

/// Iterations in which the way from the mesh must have halved.
constexpr int patience = 10;

PrestressSearch::Verdict PrestressSearch::bear(double load) {
  const int most = options_->get<int>("max iterations");
  acceleration_.forget();
  std::vector<double> history;  // of the way from the mesh
  for (int k = 1; k <= most; ++k) {
    PrestressIteration now{};
    now.load_step = point_.load_step;
    now.iteration = k;
    now.load = load;
    now.goal = goal(load);
    Verdict verdict = iterate(now);
    if (verdict.cause != Cause::none) return verdict;
    point_.load = load;
    if (!watch_->goes_on(point_, found_)) return {Cause::stopped, "stopped"};
    if (now.goal == 0.0 || now.moved <= now.goal) return {};
    history.push_back(now.moved);
    if (k > patience && now.moved > 0.5 * history[k - 1 - patience])
      return {method_->iterates_all_loads() ? Cause::nonlinear : Cause::creeps,
              "the wall comes no closer to the mesh than " + std::to_string(now.moved) + " mm"};
  }
  return {Cause::creeps, "the wall is still off the mesh after " + std::to_string(most) +
                             " iterations (\"max iterations\")"};
}

PrestressSearch::Verdict PrestressSearch::iterate(PrestressIteration& now) {
  const Stopwatch watch;
  const nonlinear::NewtonReport newton = equilibrium_.solve(now.load, found_.state);
  now.newton = newton_ = static_cast<int>(newton.steps.size());
  now.linear = newton.linear_iterations();
  Verdict verdict;
  if (newton.is_converged) {
    const std::vector<Vec3> off_mesh = equilibrium_.wall().displacement();
    now.moved = largest(off_mesh, comm());
    verdict = take_step(off_mesh);
  } else {
    verdict = {newton.is_linear_failure ? Cause::linear_solver : Cause::nonlinear, newton.reason};
  }
  note_prestretch(now);
  now.seconds = watch.seconds();
  now.reason = verdict.reason;
  watch_->report(now);
  return verdict;
}

PrestressSearch::Verdict PrestressSearch::take_step(const std::vector<Vec3>& off_mesh) {
  std::vector<Vec3> s = acceleration_.step(comm(), off_mesh);
  if (largest(s, comm()) > 5.0 * largest(off_mesh, comm())) {
    acceleration_.forget();
    s = acceleration_.step(comm(), off_mesh);
  }
  std::vector<Mat3> G = method_->prestretch_after(s);
  const Outcome outcome = equilibrium_.wall().set_prestretch(G);
  if (outcome.is_failure()) return {Cause::nonlinear, outcome.reason()};
  method_->keep();
  found_.prestretch = std::move(G);
  found_.state["pressure"].assign(equilibrium_.wall().state()["pressure"]);
  return {};
}

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
  const double pressure = options_->get<double>("pressure");
  std::ostringstream text;
  text << "the prestress, at " << load * pressure << " of " << pressure << " kPa: ";
  if (verdict.cause == Cause::linear_solver)
    text << "the linear solver gives up, whatever the wall may bear: ";
  text << verdict.reason << ". ";
  if (global_max(comm(), found_.prestretch.empty() ? 0.0 : 1.0) > 0.0) text << most_stretched();
  text
      << (verdict.cause == Cause::linear_solver
              ? ". Take another preconditioner in Wall / Linear Solver, or method = direct"
          : verdict.cause == Cause::creeps
              ? ". Is it held firmly enough (support, clamped ends)? Or take a larger \"tolerance\""
              : ". Is the wall too soft or too thin there for the pressure, or an element bad?");
  return text.str();
}

}  // namespace tunica::problems
