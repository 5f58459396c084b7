#include "tunica/stepping/bdf2.hpp"

#include "tunica/stepping/implicit_euler.hpp"

namespace tunica::stepping {

namespace {

// Parts of a history of order 1: xⁿ⁻²; of order 2: ẋⁿ⁻¹, xⁿ⁻², ẋⁿ⁻².
constexpr int velocity = 0, previous_velocity = 2;

}  // namespace

std::vector<std::string> Bdf2::remembers() const {
  if (order_ == 1) return {"previous"};
  return {"velocity", "previous", "previous velocity"};
}

Vec3 Bdf2::extrapolated(const Vec3& last, const Vec3& before) const {
  const double w = ratio();
  return 1.0 / (1.0 + 2.0 * w) * ((1.0 + w) * (1.0 + w) * last - w * w * before);
}

Vec3 Bdf2::past(const History& history, int place) const {
  return extrapolated(history.value()[place], history[order_ - 1][place]);
}

Vec3 Bdf2::prediction(const History& history, int place) const {
  const Vec3& last = history.value()[place];
  return last + ratio() * (last - history[order_ - 1][place]);
}

Vec3 Bdf2::inertia_load(const History& history, int place) const {
  // r = x̃/Δt_e² + v̂/Δt_e
  return rate() * (rate() * past(history, place) +
                   extrapolated(history[velocity][place], history[previous_velocity][place]));
}

void Bdf2::accept(const std::vector<Vec3>& x, History& history) const {
  for (std::size_t k = 0; k < x.size(); ++k) {
    if (order_ == 2) {
      const Vec3 v = rate() * (x[k] - past(history, static_cast<int>(k)));  // ẋ = (x − x̃)/Δt_e
      history[previous_velocity][k] = history[velocity][k];
      history[velocity][k] = v;
    }
    history[order_ - 1][k] = history.value()[k];
  }
  history.value() = x;
}

ErrorFormula Bdf2::value_error(const StepSizes& sizes) const {
  if (ratio() == 0.0) return ImplicitEuler(order_).value_error(sizes);
  const auto [h, h1, h2] = without_gaps(sizes);
  const double two = h + h1, three = two + h2;
  // C = (h² (h + h₁)²/(6 (2h + h₁))) / (h (h + h₁)(h + h₁ + h₂)/6)
  return {2, h * two / ((h + two) * three)};
}

SchemeEntry bdf2_scheme() {
  return {"bdf2",
          "second order",
          true,
          "",
          params::Table(),
          [](const Teuchos::ParameterList&, int order) { return std::make_unique<Bdf2>(order); }};
}

}  // namespace tunica::stepping
