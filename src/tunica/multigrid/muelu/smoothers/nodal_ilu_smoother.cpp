#include "tunica/multigrid/muelu/smoothers/nodal_ilu_smoother.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>

#include "tunica/algebra/without_pattern.hpp"

namespace tunica::multigrid {

namespace {

// Of the power method. A few bad pivots make large eigenvalues whose vectors are next to nothing in
// any start: after eight iterations one of 3.05 showed as 1.24, so that the first estimate goes on
// until it has stood still.
constexpr int first_iterations = 100, later_iterations = 2, most_later = 20;
constexpr int still_for = 15;                                ///< iterations
constexpr double still_within = 0.01;                        ///< of the estimate, over that many
constexpr int first_patience = 32, longest_patience = 1024;  ///< refreshes

// Eigenvalues of (L U)⁻¹ K that sweeps are to damp. Tried on coupled systems of tubes and vessels:
// from 0.5 to 0.6 and to 1.25 or 1.3 it makes no difference of more than one iteration.
constexpr double low = 0.55, high = 1.25;

/// w_k = 1/(½(a + b) + ½(b − a) cos((2k + 1) π/(2n)))
std::vector<double> chebyshev_weights(int n) {
  std::vector<double> weights;
  for (int k = 0; k < n; ++k)
    weights.push_back(2.0 /
                      (low + high + (high - low) * std::cos((2.0 * k + 1.0) * M_PI / (2.0 * n))));
  return weights;
}

/// What is tried in turn until the spectral radius is within its bound: fill beyond that of the
/// list, and the shift. Factors without fill are the cheapest. More fill alone makes factors of
/// flat elements grow along chains of the mesh's order (ρ = 3.6, 439, 4566 with fill 0, 1, 2 on the
/// wall of an aorta; 1.44, 1.12, 1.04 with a shift of 0.02).
struct Attempt {
  int more_fill;
  double shift;
};
constexpr Attempt attempts[] = {{0, 0.0}, {0, 0.02}, {1, 0.02}, {1, 0.05}, {2, 0.05}};
constexpr int n_attempts = static_cast<int>(std::size(attempts));

/// flatness_of_solids from which on fill pays below the spectral bound. Iterations of a tube's wall
/// with bounds 1.6 and 1.3: width over thickness 12, flatness 12, 16 and 13 at a quarter more of
/// CPU time; width over thickness 25, flatness 25, 32 and 23 at the same.
constexpr double flat = 18.0;

}  // namespace

Teuchos::RCP<const Teuchos::ParameterList> NodalIluSmoother::GetValidParameterList() const {
  const auto list = Teuchos::rcp(new Teuchos::ParameterList);
  list->set<Teuchos::RCP<const MueLu::FactoryBase>>("A", Teuchos::null, "the mixed matrix");
  list->set("sweeps", 1);
  list->set<std::string>("polynomial", "power");
  list->set("damping", 1.0);
  list->set("fill", 0);
  list->set<std::string>("precision", "half");
  list->set("most fill", 2);
  list->set("spectral bound", 1.6);
  list->set("flat bound", 1.3);
  return list;
}

void NodalIluSmoother::check(const Teuchos::ParameterList& list) const {
  validated_choice("NodalIluSmoother", list, "precision", {"half", "single", "double"});
  validated_choice("NodalIluSmoother", list, "polynomial", {"power", "chebyshev"});
  if (list.get<int>("sweeps") < 1 || !(list.get<double>("damping") > 0.0))
    throw std::invalid_argument("NodalIluSmoother: \"sweeps\" and \"damping\" must be positive.");
  if (list.get<int>("fill") < 0)
    throw std::invalid_argument("NodalIluSmoother: \"fill\" is negative.");
  if (!(list.get<double>("spectral bound") >= 0.0))
    throw std::invalid_argument("NodalIluSmoother: \"spectral bound\" is negative.");
  if (!(list.get<double>("flat bound") > 0.0))
    throw std::invalid_argument("NodalIluSmoother: \"flat bound\" must be positive.");
}

// Nothing of an earlier matrix stays: neither the attempt nor the direction of its estimate.
void NodalIluSmoother::set_up(const ::tunica::CrsMatrix& K, const algebra::DofLayout& numbering) {
  K_ = &K;
  numbering_ = numbering;
  const auto& list = GetParameterList();
  bound_ = list.get<double>("spectral bound");
  if (coarsening().flatness() > flat) bound_ = std::min(bound_, list.get<double>("flat bound"));
  memory_ = {0, 0, first_patience};
  const int sweeps = list.get<int>("sweeps");
  weights_.assign(sweeps, 1.0);
  if (list.get<std::string>("polynomial") == "chebyshev") weights_ = chebyshev_weights(sweeps);
  const auto& precision = list.get<std::string>("precision");
  precision_ = precision == "half"     ? smoothers::Precision::half
               : precision == "single" ? smoothers::Precision::single
                                       : smoothers::Precision::full;
  factors_ = nullptr;
  direction_ = nullptr;
  refresh();
}

void NodalIluSmoother::factorise(int attempt) {
  const auto& list = GetParameterList();
  const int fill = list.get<int>("fill") + attempts[attempt].more_fill;
  // Another fill has another graph; another shift does with new values.
  if (!factors_ || fill != state_.fill) {
    factors_ = nullptr;  // first: both together would not fit where one does
    factors_ = smoothers::make_node_ilu(*K_, numbering_, {fill, precision_, hosts()});
  }
  // The largest eigenvalue of other factors may lie in another direction.
  if (attempt != memory_.attempt) direction_ = nullptr;
  memory_.attempt = attempt;
  state_.fill = fill;
  state_.shift = attempts[attempt].shift;
  factors_->refresh(state_.shift);
}

bool NodalIluSmoother::is_fresh(const Memory& memory) {
  return memory.attempt == 0 && memory.patience == first_patience;
}

void NodalIluSmoother::recall(const Memory& memory) {
  if (memory.attempt < 0 || memory.attempt >= n_attempts || memory.patience < first_patience)
    return;
  if (memory.attempt != memory_.attempt) direction_ = nullptr;
  memory_ = memory;
}

// Factors of the new values, and the damping that they permit:
//
//   L U by the attempt that serves at present, or by the first one after some patience
//   ρ of (L U)⁻¹ K by the power method; where ρ exceeds the bound, further attempts
//   ω from ρ and the bound
void NodalIluSmoother::refresh() {
  const auto& list = GetParameterList();
  int attempt = memory_.attempt;
  if (attempt > 0 && ++memory_.refreshes >= memory_.patience) {
    attempt = 0;  // one bad matrix need not have been like those that follow
    memory_.refreshes = 0;
    memory_.patience = std::min(2 * memory_.patience, longest_patience);
  }
  factorise(attempt);
  state_.damping = list.get<double>("damping");
  state_.radius = 0.0;
  if (bound_ == 0.0) return;
  measure();
  if (!(state_.radius <= bound_)) search();
  // ω = min(damping, bound/ρ): no eigenvalue of ω (L U)⁻¹ K exceeds the bound.
  if (std::isfinite(state_.radius) && state_.radius > 0.0)
    state_.damping = std::min(state_.damping, bound_ / state_.radius);
  else
    direction_ = nullptr;
}

// The first attempt within the bound stays, else that of the least ρ, which is then factored again.
void NodalIluSmoother::search() {
  const int most_fill = GetParameterList().get<int>("most fill");
  int best = memory_.attempt;
  double least = state_.radius;
  for (int next = memory_.attempt + 1; next < n_attempts && !(least <= bound_); ++next) {
    if (GetParameterList().get<int>("fill") + attempts[next].more_fill > most_fill) break;
    try {
      factorise(next);
    } catch (const smoothers::TooMuchFill&) {
      break;
    }
    measure();
    if (state_.radius < least || !std::isfinite(least)) {
      least = state_.radius;
      best = next;
    }
  }
  if (factors_ && best == memory_.attempt) return;
  factorise(best);
  measure();
}

// v ← (L U)⁻¹ K v until |v| stands still: over still_for iterations the first time, since a bad
// pivot may show late, and later as soon as it does not grow.
void NodalIluSmoother::measure() {
  const bool is_new = !direction_;
  if (is_new) {
    direction_ = std::make_shared<::tunica::MultiVector>(K_->getRowMap(), 1);
    algebra::fill_without_pattern(*direction_);
  }
  std::vector<double> estimates;
  const int most = is_new ? first_iterations : most_later;
  for (int k = 0; k < most; ++k) {
    estimates.push_back(power_iteration());
    const double last = estimates.back();
    if (!(last > 0.0) || !std::isfinite(last)) break;
    if (is_new && k >= 2 * still_for &&
        std::abs(last - estimates[k - still_for]) <= still_within * last)
      break;
    if (!is_new && k + 1 >= later_iterations && last <= (1.0 + still_within) * estimates[k - 1])
      break;
  }
  state_.radius = estimates.back();
}

// ρ ≈ |v| with v ← (L U)⁻¹ K v/|v|. A sweep from v with b = 0 gives v − (L U)⁻¹ K v.
double NodalIluSmoother::power_iteration() {
  ::tunica::MultiVector &v = *direction_, zero(v.getMap(), 1), next(v.getMap(), 1);
  double size = 0.0;
  const Teuchos::ArrayView<double> norm(&size, 1);
  v.norm2(norm);
  if (!(size > 0.0)) return size;
  v.scale(1.0 / size);
  next.assign(v);
  factors_->smooth(1.0, zero, next);  // v − (L U)⁻¹ K v
  v.update(-1.0, next, 1.0);
  v.norm2(norm);
  return size;
}

void NodalIluSmoother::offer_residuals(LevelMatrix& matrix) const {
  matrix.compute_residuals_by(
      [this](const XMultiVector& b, const XMultiVector& x, XMultiVector& r) {
        factors_->residual(*unwrapped(b), *unwrapped(x), *unwrapped(r));
      });
}

std::vector<double> NodalIluSmoother::dampings() const {
  std::vector<double> all(weights_);
  for (double& damping : all) damping *= state_.damping;
  return all;
}

// e ← Π_k (1 − ω w_k (L U)⁻¹ K) e
void NodalIluSmoother::smooth(const ::tunica::MultiVector& b, ::tunica::MultiVector& x) const {
  factors_->sweep(dampings(), smoothers::NodeIlu::Start::given, b, x);
}

void NodalIluSmoother::smooth_from_zero(const ::tunica::MultiVector& b,
                                        ::tunica::MultiVector& x) const {
  factors_->sweep(dampings(), smoothers::NodeIlu::Start::zero, b, x);
}

Teuchos::RCP<MueLu::SmootherPrototype<Scalar, LocalOrdinal, GlobalOrdinal, Node>>
NodalIluSmoother::Copy() const {
  return Teuchos::rcp(new NodalIluSmoother(*this));
}

std::size_t NodalIluSmoother::getNodeSmootherComplexity() const {
  return static_cast<std::size_t>(factors_->bytes() / sizeof(Scalar));
}

}  // namespace tunica::multigrid
