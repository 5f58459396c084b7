#pragma once
#include "tunica/base/pack.hpp"
#include "tunica/kernels/tet4.hpp"

namespace tunica::materials {
class ViscosityLaw;
}

namespace tunica::kernels {

/// State of the ALE fluid on one tetrahedron of the current mesh; nodal values.
template <class Real>
struct FluidStateOf {
  std::array<Vec3Of<Real>, 4> u;      ///< velocity [mm/ms]
  std::array<Real, 4> p;              ///< pressure [kPa]
  std::array<Vec3Of<Real>, 4> u_old;  ///< velocity of the previous step [mm/ms]
  std::array<Vec3Of<Real>, 4> w;      ///< mesh velocity [mm/ms]
  std::array<Vec3Of<Real>, 4> f;      ///< body force per mass [mm/ms²], zero but for tests
  std::array<Real, 4> on_wall{};      ///< ω of fluid_up.cpp: 1 where rows have the inertia of u'
  Vec3Of<Real> subscale{};  ///< ũ', velocity of the past that the mesh does not resolve [mm/ms]
  Vec3Of<Real> viscous{};   ///< q = div 2με, which linear velocities do not have [kPa/mm]
};
using FluidState = FluidStateOf<double>;
inline void set_lane(FluidStateOf<Pack>& to, int lane, const FluidState& from) {
  set_lane(to.u, lane, from.u);
  set_lane(to.p, lane, from.p);
  set_lane(to.u_old, lane, from.u_old);
  set_lane(to.w, lane, from.w);
  set_lane(to.f, lane, from.f);
  set_lane(to.on_wall, lane, from.on_wall);
  set_lane(to.subscale, lane, from.subscale);
  set_lane(to.viscous, lane, from.viscous);
}

struct FluidCoefficients {
  double density = 0.0;                                ///< ρ [mg/mm³]
  const materials::ViscosityLaw* viscosity = nullptr;  ///< μ(γ̇)
  double inv_dt = 0.0;                                 ///< 1/Δt, zero for steady flow [1/ms]
  double viscous_factor = 4.0;                         ///< c_ν in τ
  bool has_dynamic_subscales = false;                  ///< subscales have inertia, see fluid_tau()
  bool has_skew_convection = false;  ///< convection takes out no energy inside, see fluid_up.cpp
  bool has_mean_residual = false;    ///< SUPG has only the mean of an element's residual
};

/// Derivative of τ by the mesh, at a given viscosity.
struct TauDerivative {
  double by_volume;  ///< V ∂τ/∂V [ms]
  Vec3 by_velocity;  ///< ∂τ/∂c, c the velocity at the centroid [ms²/mm]
};

/// Residual of the P1–P1 SUPG/PSPG fluid; see fluid_up.cpp for the equations.
MixedResidual fluid_up_residual(const Tet4& T, const FluidState& s, const FluidCoefficients& c,
                                double tau);

/// Residual and its exact Jacobian (tau held constant).
void fluid_up_jacobian(const Tet4& T, const FluidState& s, const FluidCoefficients& c, double tau,
                       MixedResidual& R, MixedJacobian& K);

/// Both for a pack of elements, each as the functions above have it to round-off.
void fluid_up_residual(const Tet4Of<Pack>& T, const FluidStateOf<Pack>& s,
                       const FluidCoefficients& c, const Pack& tau, MixedResidualOf<Pack>& R);
void fluid_up_jacobian(const Tet4Of<Pack>& T, const FluidStateOf<Pack>& s,
                       const FluidCoefficients& c, const Pack& tau, MixedResidualOf<Pack>& R,
                       MixedJacobianOf<Pack>& K);

/// Derivatives of the residual with respect to the positions of the vertices, which move with the
/// mesh velocity: ∂w/∂x = 1/Δt.
struct ShapeJacobian {
  double u[4][4][3][3];  ///< u[a][b][i][j] = ∂R_u[a][i]/∂x[b][j]
  double p[4][4][3];     ///< ∂R_p[a]/∂x[b][j]
};
/// ALE shape derivatives of the fluid's residual; derivative is that of τ by the mesh; see
/// fluid_up.cpp.
void fluid_up_shape_jacobian(const Tet4& T, const FluidState& s, const FluidCoefficients& c,
                             double tau, const TauDerivative& derivative, ShapeJacobian& K);

/// The subscale u' of the new time, constant on the element [mm/ms]; see fluid_up.cpp.
Vec3 fluid_subscale(const Tet4& T, const FluidState& s, const FluidCoefficients& c, double tau);

/// Power that SUPG and PSPG take out, and the inertia of u' on walls, in the symbols of
/// fluid_up.cpp: τ ∫ (Σ_a σ_a u_a + ∇p/ρ)·(m + h) dV − Σ_a ω_a ρ V/4 u_a·ũ'/Δt [kPa mm³/ms].
double fluid_stabilisation_power(const Tet4& T, const FluidState& s, const FluidCoefficients& c,
                                 double tau);

}  // namespace tunica::kernels
