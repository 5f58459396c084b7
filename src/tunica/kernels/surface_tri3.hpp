#pragma once
#include <array>

#include "tunica/base/tensor.hpp"

namespace tunica::kernels {

/// Momentum residual of a surface term on one triangle and its derivative.
struct SurfaceResidual {
  std::array<Vec3, 3> u;
};
struct SurfaceJacobian {
  double A[3][3][3][3];  ///< A[a][b][i][j] = ∂R[a][i]/∂u[b][j], or by x[b][j]
};

/// Area times outward unit normal of the triangle x, ordered counter-clockwise seen from
/// outside [mm²].
Vec3 area_normal(const std::array<Vec3, 3>& x);

/// Its derivatives: D[b][i][j] = ∂n[i]/∂x[b][j] [mm].
std::array<Mat3, 3> area_normal_derivative(const std::array<Vec3, 3>& x);

/// Dead traction: R[a] = −∫ N_a t dA on the triangle x, t constant [kPa].
SurfaceResidual dead_traction(const std::array<Vec3, 3>& x, const Vec3& t);
/// Its derivative with respect to x.
void dead_traction_shape(const std::array<Vec3, 3>& x, const Vec3& t, SurfaceJacobian& K);

/// Follower pressure on the deformed triangle X + d: R[a] = ∫ N_a p n da, p [kPa] pushing
/// against the outward normal; with its exact derivative with respect to d.
SurfaceResidual follower_pressure(const std::array<Vec3, 3>& x, double pressure);
void follower_pressure_jacobian(const std::array<Vec3, 3>& x, double pressure, SurfaceResidual& R,
                                SurfaceJacobian& K);

/// Backflow stabilisation R[a] = −β ρ ∫ (c·n)₋ u N_a da, c = u − w, (x)₋ = min(x, 0).
/// beta_rho = β ρ [mg/mm³]; nodal u and w on the current triangle x.
SurfaceResidual backflow(const std::array<Vec3, 3>& x, const std::array<Vec3, 3>& u,
                         const std::array<Vec3, 3>& w, double beta_rho);
void backflow_jacobian(const std::array<Vec3, 3>& x, const std::array<Vec3, 3>& u,
                       const std::array<Vec3, 3>& w, double beta_rho, SurfaceResidual& R,
                       SurfaceJacobian& K);
/// The derivative of backflow stabilisation with respect to x, ∂w/∂x = mesh_rate [1/ms].
void backflow_shape(const std::array<Vec3, 3>& x, const std::array<Vec3, 3>& u,
                    const std::array<Vec3, 3>& w, double beta_rho, double mesh_rate,
                    SurfaceJacobian& K);

/// Kinetic energy per unit density that the flow takes out: ∫ ½|u|² (u − w)·n da, exact [mm⁵/ms³].
double kinetic_outflow(const std::array<Vec3, 3>& x, const std::array<Vec3, 3>& u,
                       const std::array<Vec3, 3>& w);

}  // namespace tunica::kernels
