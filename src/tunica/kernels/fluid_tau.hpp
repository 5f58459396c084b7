#pragma once
#include "tunica/kernels/fluid_up.hpp"

namespace tunica::kernels {

/// SUPG/PSPG parameter τ [ms]; velocity: |c| at the centroid; viscosity: ρν. Both are known
/// beforehand, so that τ is constant in a Newton solve:
///   τ = ((2/Δt)² + (2|c|/h)² + (c_ν ν/h²)²)^(−1/2)       subscales without inertia
///   τ = (1/Δt + ((2|c|/h)² + (c_ν ν/h²)²)^(1/2))^(−1)    time-dependent subscales
double fluid_tau(const Tet4& T, const Vec3& velocity, double viscosity, const FluidCoefficients& c);

/// How it follows the mesh, at a given viscosity.
TauDerivative fluid_tau_derivative(const Tet4& T, const Vec3& velocity, double viscosity,
                                   const FluidCoefficients& c);

}  // namespace tunica::kernels
