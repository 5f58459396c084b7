#include "tunica/stepping/time_scheme.hpp"

namespace tunica::stepping {

ErrorFormula error_of_third_derivative(double c, const StepSizes& sizes) {
  // x − xᵖ has h (h + h₁)(h + h₁ + h₂)/6 of it
  const auto [h, h1, h2] = without_gaps(sizes);
  return {2, 6.0 * c * h * h / ((h + h1) * (h + h1 + h2))};
}

namespace {

template <class EntryAt>
Rows all_of(const Timeline& x, const EntryAt& entry_at) {
  Rows rows(x.value().size());
  for (std::size_t i = 0; i < rows.size(); ++i) rows[i] = entry_at(static_cast<int>(i));
  return rows;
}

}  // namespace

Rows TimeScheme::pasts(const Timeline& x) const {
  return all_of(x, [&](int i) { return past(x, i); });
}

Rows TimeScheme::predictions(const Timeline& x) const {
  return all_of(x, [&](int i) { return prediction(x, i); });
}

Rows TimeScheme::inertia_loads(const Timeline& x) const {
  return all_of(x, [&](int i) { return inertia_load(x, i); });
}

}  // namespace tunica::stepping
