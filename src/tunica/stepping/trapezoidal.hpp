#pragma once
#include "tunica/stepping/time_scheme.hpp"

namespace tunica::stepping {

/// The trapezoidal rule for an equation of first order:
///
///   ẋ = 2 (x − xⁿ⁻¹)/Δt − ẋⁿ⁻¹ = (x − x̃)/Δt_e,   Δt_e = Δt/2,   x̃ = xⁿ⁻¹ + Δt/2 ẋⁿ⁻¹
///
/// Remembers ẋ. The first step is Euler's, and any before which a scheme begins anew: ẋⁿ⁻¹ belongs
/// to the load before. Takes no energy out, nor what the start or a jump of the load has stirred
/// up. Of an equation of second order it is Newmark's scheme with β = 1/4, γ = 1/2. Source: [HNW]
/// section II.7.
class Trapezoidal final : public TimeScheme {
public:
  std::vector<std::string> remembers() const override { return {"rate"}; }
  double rate() const override { return (is_eulers() ? 1.0 : 2.0) / step_size(); }
  double past(const Timeline& x, int i) const override;
  /// xⁿ⁻¹ + Δt ẋⁿ⁻¹.
  double prediction(const Timeline& x, int i) const override;
  double inertia(double density) const override { return density * rate() * rate(); }
  /// Not asked for. Throws std::logic_error.
  double inertia_load(const Timeline& x, int i) const override;
  void accept(Rows now, Timeline& x) const override;
  int order() const override { return 2; }
  /// A step loses −Δt³/12 of the third derivative; what Euler's does where it is one.
  ErrorFormula value_error(const StepSizes& sizes) const override;

private:
  bool is_eulers() const { return previous_step_size() == 0.0; }
};

/// "trapezoidal" of fluid and wall.
SchemeEntry trapezoidal_scheme();

}  // namespace tunica::stepping
