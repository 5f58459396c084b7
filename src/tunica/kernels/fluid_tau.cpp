#include "tunica/kernels/fluid_tau.hpp"

#include <cmath>

namespace tunica::kernels {

double fluid_tau(const Tet4& T, const Vec3& velocity, double viscosity,
                 const FluidCoefficients& c) {
  const double inv_h = 1.0 / element_length(T.volume);
  const double diffusive = c.viscous_factor * viscosity / c.density * inv_h * inv_h;
  const double convective2 = 4.0 * dot(velocity, velocity) * inv_h * inv_h;
  if (c.has_dynamic_subscales)
    return 1.0 / (c.inv_dt + std::sqrt(convective2 + diffusive * diffusive));
  const double transient = 2.0 * c.inv_dt;
  return 1.0 / std::sqrt(transient * transient + convective2 + diffusive * diffusive);
}

TauDerivative fluid_tau_derivative(const Tet4& T, const Vec3& velocity, double viscosity,
                                   const FluidCoefficients& c) {
  const double tau = fluid_tau(T, velocity, viscosity, c);
  const double inv_h = 1.0 / element_length(T.volume);
  const double diffusive = c.viscous_factor * viscosity / c.density * inv_h * inv_h;
  const double convective2 = 4.0 * dot(velocity, velocity) * inv_h * inv_h;
  // both parts of 1/τ_s² = q fall as powers of h = O(V^1/3)
  const double q = convective2 + diffusive * diffusive;
  const double q_by_volume = -2.0 / 3.0 * convective2 - 4.0 / 3.0 * diffusive * diffusive;
  const Vec3 q_by_velocity = 8.0 * inv_h * inv_h * velocity;
  double factor = -0.5 * tau * tau * tau;  // τ = (4/Δt² + q)^(−1/2)
  if (c.has_dynamic_subscales)             // τ = (1/Δt + q^(1/2))^(−1)
    factor = q > 0.0 ? -0.5 * tau * tau / std::sqrt(q) : 0.0;
  return {factor * q_by_volume, factor * q_by_velocity};
}

}  // namespace tunica::kernels
