#pragma once
#include "tunica/kernels/tet4.hpp"
#include "tunica/materials/wall_law.hpp"

namespace tunica::kernels {

/// State of the mixed solid on one tetrahedron; nodal values.
template <class Real>
struct SolidStateOf {
  std::array<Vec3Of<Real>, 4> d;  ///< displacement [mm]
  std::array<Real, 4> p;          ///< pressure, compression positive [kPa]
  std::array<Vec3Of<Real>, 4> r;  ///< ρ (a − f) = alpha d − r, f a body force [kPa/mm]
  Vec3Of<Real> subscale_r{};      ///< time scheme of the subscale: ρ a' = alpha d' − r' [kPa/mm]
};
using SolidState = SolidStateOf<double>;
inline void set_lane(SolidStateOf<Pack>& to, int lane, const SolidState& from) {
  set_lane(to.d, lane, from.d);
  set_lane(to.p, lane, from.p);
  set_lane(to.r, lane, from.r);
  set_lane(to.subscale_r, lane, from.subscale_r);
}

/// Constants of one element.
template <class Real>
struct SolidCoefficientsOf {
  Real alpha;        ///< ρ/(βΔt²), zero in statics [kPa/mm²]
  Real inv_kappa;    ///< 1/κ, zero for the incompressible limit [1/kPa]
  Real tau;          ///< PSPG parameter [mm²/kPa]
  Real tau_v = 0.0;  ///< of the volumetric subscale [kPa]
};
using SolidCoefficients = SolidCoefficientsOf<double>;
inline void set_lane(SolidCoefficientsOf<Pack>& to, int lane, const SolidCoefficients& from) {
  set_lane(to.alpha, lane, from.alpha);
  set_lane(to.inv_kappa, lane, from.inv_kappa);
  set_lane(to.tau, lane, from.tau);
  set_lane(to.tau_v, lane, from.tau_v);
}

/// det F of the element; positive unless it is inverted.
double solid_jacobian_determinant(const Tet4& T, const std::array<Vec3, 4>& d);

/// The subscale d' of the new time, constant on the element [mm]; see solid_up.cpp.
Vec3 solid_subscale(const Tet4& T, const SolidState& s, const SolidCoefficients& c);

/// The law of an element, with what it sees beside the deformation: the frame where it has fibres,
/// the past where it remembers.
struct LawAtElement {
  LawAtElement(const materials::WallLaw& of, const materials::Frame& in = {},  // NOLINT: the law
               const materials::Past& before = {})
      : law(&of), frame(in), past(before) {}

  const materials::WallLaw* law;
  materials::Frame frame;
  materials::Past past;
};

/// Residual of the P1–P1 mixed solid; see solid_up.cpp for the equations. det F > 0 is the
/// caller's promise.
MixedResidual solid_up_residual(const Tet4& T, const SolidState& s, const LawAtElement& at,
                                const SolidCoefficients& c);

/// Residual and its exact Jacobian.
void solid_up_jacobian(const Tet4& T, const SolidState& s, const LawAtElement& at,
                       const SolidCoefficients& c, MixedResidual& R, MixedJacobian& K);

/// The laws of a pack of elements with their frames and pasts.
struct PackedLaws {
  std::array<const materials::WallLaw*, Pack::size> laws;
  materials::FrameOf<Pack> frames;  ///< matter where a law has fibres
  materials::PackedPast pasts{};    ///< matter where a law remembers
};

/// Both for a pack of elements, each as the functions above have it to round-off.
void solid_up_residual(const Tet4Of<Pack>& T, const SolidStateOf<Pack>& s, const PackedLaws& laws,
                       const SolidCoefficientsOf<Pack>& c, MixedResidualOf<Pack>& R);
void solid_up_jacobian(const Tet4Of<Pack>& T, const SolidStateOf<Pack>& s, const PackedLaws& laws,
                       const SolidCoefficientsOf<Pack>& c, MixedResidualOf<Pack>& R,
                       MixedJacobianOf<Pack>& K);

}  // namespace tunica::kernels
