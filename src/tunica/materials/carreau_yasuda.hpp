#pragma once
#include "tunica/materials/viscosity_registry.hpp"

namespace tunica::materials {

/// A fluid that thins with the shear rate, as blood does by its red cells:
///
///   μ = μ∞ + (μ₀ − μ∞) (1 + (λγ̇)^a)^((n − 1)/a)
///
///   μ₀, μ∞  at rest, at high rates   kPa ms      λ  time       ms
///   n       power of a power law     1           a  sharpness  1
///
/// a = 2 is Carreau's law. Source: [Yas].
class CarreauYasuda final : public ViscosityLaw {
public:
  struct Constants {
    double at_rest, at_high_rates;  ///< μ₀, μ∞
    double time;                    ///< λ
    double power, sharpness;        ///< n, a
  };
  explicit CarreauYasuda(const Constants& constants) : c_(constants) {}

  Viscosity at(double squared_shear_rate) const override;
  double reference() const override { return c_.at_high_rates; }

private:
  Constants c_;
};

/// "carreau-yasuda" of a fluid; by default blood of a hematocrit of 45 %.
ViscosityEntry carreau_yasuda();

}  // namespace tunica::materials
