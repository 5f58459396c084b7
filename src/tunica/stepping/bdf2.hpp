#pragma once
#include "tunica/stepping/time_scheme.hpp"

namespace tunica::stepping {

/// BDF2, written as an implicit Euler step of length Δt_e from an extrapolated past:
///
///   ẋ = (x − x̃)/Δt_e,   ẍ = (ẋ − v̂)/Δt_e,   x̃ and v̂ extrapolated alike from x and ẋ
///
///   Δt_e = Δt (1 + ω)/(1 + 2ω),   x̃ = ((1 + ω)² xⁿ⁻¹ − ω² xⁿ⁻²)/(1 + 2ω),   ω = Δt/Δtⁿ⁻¹
///
/// With equal steps Δt_e = 2Δt/3 and x̃ = (4xⁿ⁻¹ − xⁿ⁻²)/3. The first step is Euler's: ω = 0.
/// Second order where the solution is smooth, and no less stable than Euler's up to ω = 1 + √2.
/// Source: [HNW] section III.5.
class Bdf2 final : public TimeScheme {
public:
  /// order: of the highest derivative that is asked for, 1 or 2.
  explicit Bdf2(int order) : order_(order) {}

  std::vector<std::string> remembers() const override;
  double rate() const override { return (1.0 + 2.0 * ratio()) / (1.0 + ratio()) / step_size(); }
  double past(const Timeline& x, int i) const override;
  /// (1 + ω) xⁿ⁻¹ − ω xⁿ⁻².
  double prediction(const Timeline& x, int i) const override;
  double inertia(double density) const override { return density * rate() * rate(); }
  double inertia_load(const Timeline& x, int i) const override;
  void accept(Rows now, Timeline& x) const override;
  int order() const override { return 2; }
  /// A step loses −Δt²(Δt + Δtⁿ⁻¹)²/(6 (2Δt + Δtⁿ⁻¹)) of the third derivative, −2/9 Δt³ with equal
  /// steps; what Euler's does where it is one.
  ErrorFormula value_error(const StepSizes& sizes) const override;

private:
  /// ω, zero in the first step.
  double ratio() const {
    return previous_step_size() > 0.0 ? step_size() / previous_step_size() : 0.0;
  }
  double extrapolated(double last, double before) const;

  int order_;
};

/// "bdf2" of fluid and wall.
SchemeEntry bdf2_scheme();

}  // namespace tunica::stepping
