#pragma once
#include "tunica/materials/wall_law.hpp"

namespace tunica::judge {

/// Young's modulus around the circumference of a wall of this law and bulk modulus κ [kPa], where
/// it begins to widen at constant length: fibres that then are stretched carry.
///
///   E = 1/(D⁻¹)_θθ,   D = D' + κ I⊗I
///
///   D'  tangent of the isochoric law     kPa     θ   around the circumference
double circumferential_modulus(const materials::WallLaw& law, double kappa);

/// κ beyond 50 times the shear modulus: ν above 0.49.
inline bool is_nearly_incompressible(const materials::WallLaw& law, double kappa) {
  return kappa >= 50.0 * circumferential_modulus(law, kappa) / 3.0;
}

}  // namespace tunica::judge
