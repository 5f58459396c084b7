#include "tunica/multigrid/muelu/smoothers/nodal_ilu_smoother.hpp"

#include <algorithm>
#include <cmath>

#include "tunica/multigrid/muelu/validated_choice.hpp"

namespace tunica::multigrid {

namespace {

// Of the power method: at first, and where matrix and direction are near to the last ones.
constexpr int first_iterations = 8, later_iterations = 2;
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

}  // namespace

Teuchos::RCP<const Teuchos::ParameterList> NodalIluSmoother::GetValidParameterList() const {
  const auto list = Teuchos::rcp(new Teuchos::ParameterList);
  list->set<Teuchos::RCP<const MueLu::FactoryBase>>("A", Teuchos::null, "the mixed matrix");
  list->set("sweeps", 1);
  list->set<std::string>("polynomial", "power");
  list->set("damping", 1.0);
  list->set("fill", 0);
  list->set<std::string>("precision", "single");
  list->set("most fill", 2);
  list->set("spectral bound", 1.6);
  return list;
}

void NodalIluSmoother::check(const Teuchos::ParameterList& list) const {
  validated_choice("NodalIluSmoother", list, "precision", {"single", "double"});
  validated_choice("NodalIluSmoother", list, "polynomial", {"power", "chebyshev"});
  if (list.get<int>("sweeps") < 1 || !(list.get<double>("damping") > 0.0))
    throw std::invalid_argument("NodalIluSmoother: \"sweeps\" and \"damping\" must be positive.");
  if (list.get<int>("fill") < 0)
    throw std::invalid_argument("NodalIluSmoother: \"fill\" is negative.");
  if (!(list.get<double>("spectral bound") >= 0.0))
    throw std::invalid_argument("NodalIluSmoother: \"spectral bound\" is negative.");
}

void NodalIluSmoother::set_up(const ::tunica::CrsMatrix& K, const algebra::DofLayout& numbering) {
  K_ = &K;
  numbering_ = numbering;
  const auto& list = GetParameterList();
  fill_ = list.get<int>("fill");
  refreshes_ = 0;
  patience_ = first_patience;
  const int sweeps = list.get<int>("sweeps");
  weights_.assign(sweeps, 1.0);
  if (list.get<std::string>("polynomial") == "chebyshev") weights_ = chebyshev_weights(sweeps);
  make_factors();
  refresh();
}

void NodalIluSmoother::make_factors() {
  factors_ = nullptr;  // first: both together would not fit where one does
  factors_ = smoothers::make_node_ilu(
      *K_, numbering_,
      {fill_, GetParameterList().get<std::string>("precision") == "single", hosts()});
  direction_ = nullptr;
}

void NodalIluSmoother::refresh() {
  const auto& list = GetParameterList();
  const double bound = list.get<double>("spectral bound");
  if (fill_ > list.get<int>("fill") && ++refreshes_ >= patience_) {
    fill_ = list.get<int>("fill");  // one bad matrix need not have been like those that follow
    refreshes_ = 0;
    patience_ = std::min(2 * patience_, longest_patience);
    make_factors();
  }
  factors_->refresh();
  damping_ = list.get<double>("damping");
  if (bound == 0.0) return;
  double radius = spectral_radius(direction_ ? later_iterations : first_iterations);
  while (radius > bound && fill_ < list.get<int>("most fill")) {
    ++fill_;
    make_factors();
    factors_->refresh();
    radius = spectral_radius(first_iterations);
  }
  if (std::isfinite(radius) && radius > 0.0)
    damping_ = std::min(damping_, bound / radius);
  else
    direction_ = nullptr;
}

double NodalIluSmoother::spectral_radius(int iterations) {
  if (!direction_) {
    direction_ = std::make_shared<::tunica::MultiVector>(K_->getRowMap(), 1);
    const auto start = direction_->getLocalViewHost(overwrite_all);
    for (std::size_t i = 0; i < start.extent(0); ++i)  // no pattern that a mesh could have
      start(i, 0) = std::sin(
          78.233 * static_cast<double>(K_->getRowMap()->getGlobalElement(static_cast<int>(i))) +
          1.0);
  }
  ::tunica::MultiVector &v = *direction_, zero(v.getMap(), 1), next(v.getMap(), 1);
  double size = 0.0;
  const Teuchos::ArrayView<double> norm(&size, 1);
  v.norm2(norm);
  for (int k = 0; k < iterations && size > 0.0; ++k) {
    v.scale(1.0 / size);
    next.assign(v);
    factors_->smooth(1.0, zero, next);  // v − (L U)⁻¹ K v
    v.update(-1.0, next, 1.0);
    v.norm2(norm);
  }
  return size;
}

void NodalIluSmoother::smooth(const ::tunica::MultiVector& b, ::tunica::MultiVector& x) const {
  for (const double weight : weights_) factors_->smooth(damping_ * weight, b, x);
}

void NodalIluSmoother::smooth_from_zero(const ::tunica::MultiVector& b,
                                        ::tunica::MultiVector& x) const {
  factors_->smooth_from_zero(damping_ * weights_.front(), b, x);
  for (std::size_t k = 1; k < weights_.size(); ++k) factors_->smooth(damping_ * weights_[k], b, x);
}

Teuchos::RCP<MueLu::SmootherPrototype<Scalar, LocalOrdinal, GlobalOrdinal, Node>>
NodalIluSmoother::Copy() const {
  return Teuchos::rcp(new NodalIluSmoother(*this));
}

std::size_t NodalIluSmoother::getNodeSmootherComplexity() const {
  return static_cast<std::size_t>(factors_->bytes() / sizeof(Scalar));
}

}  // namespace tunica::multigrid
