#pragma once
#include "tunica/stepping/time_scheme.hpp"

namespace tunica::stepping {

/// Implicit Euler:
///
///   ẋ = (x − xⁿ⁻¹)/Δt,   ẍ = (ẋ − ẋⁿ⁻¹)/Δt = x/Δt² − (xⁿ⁻¹/Δt² + ẋⁿ⁻¹/Δt)
///
/// Source: [LY1] section 4.1 for the fluid, where only ẋ is needed.
class ImplicitEuler final : public TimeScheme {
public:
  /// order: of the highest derivative that is asked for, 1 or 2.
  explicit ImplicitEuler(int order) : order_(order) {}

  std::vector<std::string> remembers() const override;
  double rate() const override { return 1.0 / step_size(); }
  double past(const Timeline& x, int i) const override { return x.value()[i]; }
  double prediction(const Timeline& x, int i) const override { return x.value()[i]; }
  double inertia(double density) const override { return density / (step_size() * step_size()); }
  double inertia_load(const Timeline& x, int i) const override;
  void accept(Rows now, Timeline& x) const override;
  int order() const override { return 1; }
  /// A step loses −½Δt² ẍ, and x − xᵖ = Δt (ẋⁿ − ẋⁿ⁻¹) at any steps, ẋ being the scheme's.
  ErrorFormula value_error(const StepSizes&) const override { return {1, 0.5}; }

private:
  int order_;
};

/// "implicit euler" of fluid and wall.
SchemeEntry implicit_euler_scheme();

}  // namespace tunica::stepping
