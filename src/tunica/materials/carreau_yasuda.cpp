#include "tunica/materials/carreau_yasuda.hpp"

#include <cmath>

namespace tunica::materials {

Viscosity CarreauYasuda::at(double squared_shear_rate) const {
  // s = (λγ̇)^a, ds/d(γ̇²) = a s/(2γ̇²); with a < 2 the slope has no bound at rest, but what it
  // multiplies, a square of the strain rates, goes to zero faster.
  const double q = squared_shear_rate, a = c_.sharpness, m = (c_.power - 1.0) / a;
  const double excess = c_.at_rest - c_.at_high_rates;
  if (q == 0.0) return {c_.at_rest, 0.0};
  const double s = std::pow(c_.time * c_.time * q, 0.5 * a);
  const double thinned = excess * std::pow(1.0 + s, m);
  return {c_.at_high_rates + thinned, thinned * m / (1.0 + s) * a * s / (2.0 * q)};
}

namespace {

Constant positive(const std::string& name, double fallback, const std::string& unit,
                  const std::string& sentence) {
  Constant constant{name, fallback, 0.0, unit, sentence};
  constant.is_low_excluded = true;
  return constant;
}

}  // namespace

ViscosityEntry carreau_yasuda() {
  return {"carreau-yasuda",
          "Shear-thinning, by default like blood [ChK].",
          {positive("viscosity", 3.45e-3, "kPa ms", "mu_inf at high shear rates"),
           positive("viscosity at rest", 0.056, "kPa ms", "mu_0"),
           positive("time constant", 3313.0, "ms", "lambda of 1 + (lambda rate)^a"),
           {"power", 0.3568, 0.0, "1", "n; 1 is Newtonian", 1.0},
           positive("sharpness", 2.0, "1", "a; 2 is the law of Carreau")},
          [](const Constants& value) {
            return std::make_unique<CarreauYasuda>(CarreauYasuda::Constants{
                value.at("viscosity at rest"), value.at("viscosity"), value.at("time constant"),
                value.at("power"), value.at("sharpness")});
          }};
}

}  // namespace tunica::materials
