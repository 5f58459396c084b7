#pragma once
#include "tunica/kernels/tet4.hpp"
#include "tunica/materials/viscosity_law.hpp"

namespace tunica::kernels {

/// ∫ |v|² dV of the linear field with these values at the vertices: V/20 (|Σv_a|² + Σ|v_a|²).
double squared_norm(double volume, const std::array<Vec3, 4>& v);
double squared_norm(double volume, const std::array<double, 4>& v);

/// ∫ 2μ ε(u):ε(u) dV, the power that the viscosity μ turns into heat [kPa mm³/ms].
double viscous_dissipation(const Tet4& T, const std::array<Vec3, 4>& u,
                           const materials::ViscosityLaw& viscosity);

/// ∫ ½ρ |u|² div u dV, the power that convection of density ρ [mg/mm³] brings where the velocity is
/// not free of divergence [kPa mm³/ms].
double power_of_divergence(const Tet4& T, const std::array<Vec3, 4>& u, double density);

/// Power that a wall's pressure does on its subscale, −∫ J F⁻ᵀ∇p · v' dV, v' the subscale's
/// velocity [kPa mm³/ms]. It takes the element for rigid while the subscale moves.
double subscale_power(const Tet4& T, const std::array<Vec3, 4>& d, const std::array<double, 4>& p,
                      const Vec3& velocity);

}  // namespace tunica::kernels
