#include "tunica/stepping/bdf2.hpp"

#include "tunica/stepping/implicit_euler.hpp"

namespace tunica::stepping {

namespace {

// Remembered beside xⁿ⁻¹, of order 1: xⁿ⁻²; of order 2: ẋⁿ⁻¹, xⁿ⁻², ẋⁿ⁻².
constexpr int velocity = 0, previous_velocity = 2;

}  // namespace

std::vector<std::string> Bdf2::remembers() const {
  if (order_ == 1) return {"previous"};
  return {"velocity", "previous", "previous velocity"};
}

double Bdf2::extrapolated(double last, double before) const {
  const double w = ratio();
  return 1.0 / (1.0 + 2.0 * w) * ((1.0 + w) * (1.0 + w) * last - w * w * before);
}

double Bdf2::past(const Timeline& x, int i) const {
  return extrapolated(x.value()[i], x[order_ - 1][i]);
}

double Bdf2::prediction(const Timeline& x, int i) const {
  const double last = x.value()[i];
  return last + ratio() * (last - x[order_ - 1][i]);
}

double Bdf2::inertia_load(const Timeline& x, int i) const {
  // r = x̃/Δt_e² + v̂/Δt_e
  return rate() * (rate() * past(x, i) + extrapolated(x[velocity][i], x[previous_velocity][i]));
}

void Bdf2::accept(Rows now, Timeline& x) const {
  for (std::size_t i = 0; i < now.size(); ++i) {
    if (order_ == 2) {
      const double v = rate() * (now[i] - past(x, static_cast<int>(i)));  // ẋ = (x − x̃)/Δt_e
      x[previous_velocity][i] = x[velocity][i];
      x[velocity][i] = v;
    }
    x[order_ - 1][i] = x.value()[i];
  }
  x.push(std::move(now));
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
