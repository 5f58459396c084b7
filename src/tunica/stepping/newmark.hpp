#pragma once
#include "tunica/stepping/time_scheme.hpp"

namespace tunica::stepping {

/// Newmark's scheme in displacement form:
///
///   a = (d − dⁿ⁻¹)/(βΔt²) − vⁿ⁻¹/(βΔt) − (1 − 2β)/(2β) aⁿ⁻¹
///   v = vⁿ⁻¹ + (1 − γ)Δt aⁿ⁻¹ + γΔt a
///
/// Its first step, and any before which a scheme begins anew, may be implicit Euler's, which finds
/// the acceleration of the load there and keeps the order: aⁿ⁻¹ = 0 of a wall at rest is not that
/// of a load that is there from the first instant.
///
/// Remembers v and a. Source: [LY1] section 4.1; β = 0.625, γ = 1 there.
class Newmark final : public TimeScheme {
public:
  enum class Start { rest, implicit_euler };

  Newmark(double beta, double gamma, Start start = Start::rest)
      : beta_(beta), gamma_(gamma), start_(start) {}
  /// From a resolved "Newmark" list.
  explicit Newmark(const Teuchos::ParameterList& list);

  std::vector<std::string> remembers() const override { return {"velocity", "acceleration"}; }
  /// v = γ/(βΔt) (d − x̃).
  double rate() const override { return gamma() / (beta() * step_size()); }
  double past(const Timeline& x, int i) const override;
  /// dⁿ⁻¹ + Δt vⁿ⁻¹.
  double prediction(const Timeline& x, int i) const override {
    return x.value()[i] + step_size() * x[0][i];
  }
  double inertia(double density) const override {
    return density / (beta() * step_size() * step_size());
  }
  double inertia_load(const Timeline& x, int i) const override;
  void accept(Rows now, Timeline& x) const override;
  int order() const override { return gamma_ == 0.5 ? 2 : 1; }
  /// A step loses (1/6 − β) Δt³ ȧ in d, and in v (½ − γ) Δt² ȧ or, with γ = ½, −Δt³ ä/12.
  ErrorFormula value_error(const StepSizes& sizes) const override;
  ErrorFormula velocity_error(const StepSizes& sizes) const override;

private:
  /// vⁿ⁻¹/(βΔt) + (1 − 2β)/(2β) aⁿ⁻¹.
  double momentum(const Timeline& x, int i) const;
  /// Euler's step is that with β = γ = 1 and without aⁿ⁻¹.
  bool is_eulers() const { return start_ == Start::implicit_euler && previous_step_size() == 0.0; }
  double beta() const { return is_eulers() ? 1.0 : beta_; }
  double gamma() const { return is_eulers() ? 1.0 : gamma_; }

  double beta_, gamma_;
  Start start_;
};

/// "newmark" of a wall.
SchemeEntry newmark_scheme();

}  // namespace tunica::stepping
