#pragma once
#include "tunica/kernels/solid_up.hpp"

namespace tunica::kernels {

/// An element in statics that stays in place while its prestretch G changes.
struct PrestretchedElement {
  Tet4 in_place;
  Tet4 stress_free;
  std::array<Vec3, 4> d;    ///< from there to its place [mm]
  std::array<double, 4> p;  ///< of its vertices [kPa]
  SolidCoefficients coefficients;
  const materials::WallLaw* law;
  materials::Frame frame;           ///< of its fibres, where it is free of stress
  materials::Frame frame_in_place;  ///< does not change
};

/// Correction of the Jacobian of solid_up_jacobian(), which is by a motion s of the element. Their
/// sum is the derivative of the residual, without body forces, by s in G ← (I + ε) G, ε the
/// symmetric part of ∇s. The blocks A and B2; the others are zero.
MixedJacobian prestretch_jacobian(const PrestretchedElement& element);

}  // namespace tunica::kernels
