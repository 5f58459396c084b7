#pragma once
#include "tunica/kernels/tet4.hpp"
#include "tunica/materials/hyperelastic_law.hpp"

namespace tunica::kernels {

/// What the mixed solid needs on one tetrahedron; nodal values.
struct SolidState {
  std::array<Vec3, 4> d;    ///< displacement [mm]
  std::array<double, 4> p;  ///< pressure, compression positive [kPa]
  std::array<Vec3, 4> r;    ///< time scheme and body force f: ρ (a − f) = alpha d − r [kPa/mm]
  Vec3 subscale_r{};        ///< time scheme of the subscale: ρ a' = alpha d' − r' [kPa/mm]
};

/// Constants of one element.
struct SolidCoefficients {
  double alpha;      ///< ρ/(βΔt²), zero in statics [kPa/mm²]
  double inv_kappa;  ///< 1/κ, zero for the incompressible limit [1/kPa]
  double tau;        ///< PSPG parameter [mm²/kPa]
  double tau_v = 0;  ///< of the volumetric subscale [kPa]
};

/// det F of the element; positive unless it is inverted.
double solid_jacobian_determinant(const Tet4& T, const std::array<Vec3, 4>& d);

/// The subscale d' of the new time, constant on the element [mm]; see solid_up.cpp.
Vec3 solid_subscale(const Tet4& T, const SolidState& s, const SolidCoefficients& c);

/// Residual of the P1–P1 mixed solid; see solid_up.cpp for the equations. det F > 0 is the
/// caller's promise. frame: matters for laws with fibres only.
MixedResidual solid_up_residual(const Tet4& T, const SolidState& s,
                                const materials::HyperelasticLaw& law, const SolidCoefficients& c,
                                const materials::Frame& frame = {});

/// Residual and its exact Jacobian.
void solid_up_jacobian(const Tet4& T, const SolidState& s, const materials::HyperelasticLaw& law,
                       const SolidCoefficients& c, MixedResidual& R, MixedJacobian& K,
                       const materials::Frame& frame = {});

}  // namespace tunica::kernels
