#include "tunica/stepping/time_scheme.hpp"

namespace tunica::stepping {

History::History(std::vector<std::string> names, int n_places)
    : names_(std::move(names)), parts_(names_.size() + 1, std::vector<Vec3>(n_places)) {}

ErrorFormula error_of_third_derivative(double c, const StepSizes& sizes) {
  // x − xᵖ has h (h + h₁)(h + h₁ + h₂)/6 of it
  const auto [h, h1, h2] = without_gaps(sizes);
  return {2, 6.0 * c * h * h / ((h + h1) * (h + h1 + h2))};
}

namespace {

template <class ValueAt>
std::vector<Vec3> all_of(const History& history, const ValueAt& value_at) {
  std::vector<Vec3> values(history.value().size());
  for (std::size_t k = 0; k < values.size(); ++k) values[k] = value_at(static_cast<int>(k));
  return values;
}

}  // namespace

std::vector<Vec3> TimeScheme::pasts(const History& history) const {
  return all_of(history, [&](int place) { return past(history, place); });
}

std::vector<Vec3> TimeScheme::predictions(const History& history) const {
  return all_of(history, [&](int place) { return prediction(history, place); });
}

}  // namespace tunica::stepping
