#include "tunica/kernels/fluid_up.hpp"

#include "tunica/kernels/viscosity.hpp"

namespace tunica::kernels {

// The P1–P1 SUPG/PSPG fluid on one tetrahedron of the current mesh, non-conservative ALE.
//
//   R_u[a] = ∫ N_a m + 2μ ε(u)∇N_a − p ∇N_a dV + τ ∫ s_a (m + h) dV
//   R_p[a] = −∫ N_a div u dV − (τ/ρ) ∫ ∇N_a·(m + h) dV
//   m      = ρ ((u − u_old)/Δt + G c − f),   c = u − w,   s_a = c·∇N_a
//   h      = ∇p − ρ ũ'/Δt − q
//
// and, where convection is skew-symmetric, R_u[a] += ½ρ ∫ N_a (div u) u dV, which is zero but for
// what stabilisation leaves of div u, and balances the energy ½ρ ∫ |u|² div u that it would bring.
//
//   u, u_old  velocity, that of the last step   mm/ms    ρ  density     mg/mm³
//   w         mesh velocity                     mm/ms    μ  μ(γ̇)        kPa ms
//   p         pressure                          kPa      τ  SUPG/PSPG   ms
//   G         Σ_a u_a ⊗ ∇N_a = ∇u, constant     1/ms     f  body force  mm/ms²
//   ũ'        subscale of the past, constant    mm/ms    q  div 2με     kPa/mm
//
// The subscale u' is what the mesh does not resolve of the velocity, a vector per element driven
// by the mean residual, with inertia of its own where it is time-dependent:
//
//   ρ (u' − ũ')/Δt + ρ u'/τ_s = −(m̄ + ∇p − q),   hence   u' = −(τ/ρ) (m̄ + h),   1/τ = 1/Δt + 1/τ_s
//
// Without inertia ũ' = 0 and Δt stands in τ only. It is linear in u', so that it needs no unknown.
// Its inertia in the momentum rows is left out, but for the rows of vertices where the fluid sticks
// to a wall, ω_a = 1 there and 0 elsewhere:
//
//   R_u[a] += ω_a ∫ N_a ρ (u' − ũ')/Δt = −ω_a (V/4) [(τ/Δt) (m̄ + h) + ρ ũ'/Δt]
//
// Where elements are larger than the boundary layer, linear velocities that stick to the wall lack
// momentum, which u' has: PSPG lets it flow. Without its inertia these rows, which are the force on
// the wall, have what accelerates it, so that the wall is drawn along: by 0.29 h ∂p/∂x in a half
// space in which an inviscid fluid is set in motion, by 0.11 h with it, where nothing is right. It
// is what SUPG with s_a − ω_a/(4Δt) in the place of s_a gives, called σ_a below, and a known force.
//
// m, c and s_a are linear on the element; integrals of products are exact by
// ∫ f g = V/20 (Σf Σg + Σ_k f_k g_k). SUPG may have the means of its factors only, V/16 Σf Σg in
// the place of that: then −ρ ∫ s_a u' is all of it. What else it has, τ ∫ (s_a − s̄_a) (m − m̄),
// vanishes with Δt as τ does, at first order, which no time scheme mends. The Jacobian is exact at
// fixed τ, with full convective derivative and the derivative of the test function s_a:
//
//   A[a][b]   = δ {ρ [W_ab/Δt + ∫(N_a + τ σ_a) s_b] + μ V ∇N_a·∇N_b} + ρ W_ab G
//               + (τ ∫N_b (m + h) + μ V ∇N_b) ⊗ ∇N_a,     W_ab = ∫ (N_a + τ σ_a) N_b
//               (+ ½ρ [δ div u ∫N_a N_b + ∫N_a u ⊗ ∇N_b])
//               (+ 2μ' V e∇N_a ⊗ e∇N_b,   e = 2ε = G + Gᵀ,   μ' = dμ/d(γ̇²), γ̇² = ½ e:e)
//   B1ᵀ[a][b] = −V/4 ∇N_a + τ V σ̄_a ∇N_b
//   B2[a][b]  = −V/4 ∇N_b − τ V [(1/(4Δt) + s̄_b) ∇N_a + Gᵀ∇N_a/4]
//   −C[a][b]  = −(τ/ρ) V ∇N_a·∇N_b
//
// A vertex b that moves along e_j takes the geometry and the mesh velocity with it:
//
//   dV = V ∂_j N_b    d∇N_a = −∂_j N_a ∇N_b    dw_b = e_j/Δt
//
// so that with t_b[k] = s_b[k] + δ_bk/Δt and G_j = G e_j
//
//   dG = −G_j ⊗ ∇N_b    ds_a[k] = −∂_j N_a t_b[k]    dm_k = −ρ t_b[k] G_j    dh = −∂_j p ∇N_b
//   dμ = −2μ' G_j·e∇N_b
//
// in all terms of the residual; dτ = V ∂τ/∂V ∂_j N_b − ∂τ/∂c_j/(4Δt).
//
// Source: [LY1] eq:weakns, written without the inlet term (surface_tri3.hpp); [CPGB07] for the
// subscales in time; [Tem] for skew-symmetric convection.
// Deviation: [LY1] names SUPG/PSPG without its terms; these are the residual-based ones of P1,
// where the viscous part of the strong residual vanishes, so that q is zero or reconstructed from
// the neighbours of the element (assembly/viscous_residual.hpp) and known beforehand.

namespace {

template <class Real>
struct Point {
  Mat3Of<Real> G;
  materials::ViscosityOf<Real> mu;
  Vec3Of<Real> h;
  Vec3Of<Real> m[4];
  Real s[4][4];   ///< s[a][k], value of s_a at vertex k
  Real s_sum[4];  ///< Σ_k s[a][k]
  Real t[4][4];   ///< σ_a at vertex k, with which SUPG tests
  Real t_sum[4];
  Vec3Of<Real> past[4];  ///< ω_a ρ V/4 ũ'/Δt
  Vec3Of<Real> Nu[4];    ///< ∫ N_a u dV, where convection is skew-symmetric
  Real sums;             ///< τ∫ f g of SUPG = sums Σf Σg + products Σ_k f_k g_k
  Real products;
  Real p_mean;
};

template <class Real>
Point<Real> evaluate(const Tet4Of<Real>& T, const FluidStateOf<Real>& s, const FluidCoefficients& c,
                     const Real& tau) {
  Point<Real> x;
  x.sums = tau * T.volume / (c.has_mean_residual ? 16.0 : 20.0);
  x.products = c.has_mean_residual ? 0.0 : x.sums;
  x.G = {};
  x.h = -c.density * c.inv_dt * s.subscale - s.viscous;
  for (int a = 0; a < 4; ++a)
    for (int j = 0; j < 3; ++j) {
      x.h[j] += s.p[a] * T.grad_N[a][j];
      for (int i = 0; i < 3; ++i) x.G[i][j] += s.u[a][i] * T.grad_N[a][j];
    }
  x.mu = viscosity_at(*c.viscosity, x.G);
  for (int a = 0; a < 4; ++a) x.s_sum[a] = 0.0;
  for (int k = 0; k < 4; ++k) {
    const Vec3Of<Real> v = s.u[k] - s.w[k];
    for (int a = 0; a < 4; ++a) {
      x.s[a][k] = dot(v, T.grad_N[a]);
      x.s_sum[a] += x.s[a][k];
    }
    for (int i = 0; i < 3; ++i)
      x.m[k][i] = c.density * ((s.u[k][i] - s.u_old[k][i]) * c.inv_dt + dot(x.G[i], v) - s.f[k][i]);
  }
  for (int a = 0; a < 4; ++a) {
    const Real rate = c.inv_dt * s.on_wall[a];
    for (int k = 0; k < 4; ++k) x.t[a][k] = x.s[a][k] - 0.25 * rate;
    x.t_sum[a] = x.s_sum[a] - rate;
    x.past[a] = 0.25 * c.density * T.volume * rate * s.subscale;
  }
  x.p_mean = 0.25 * (s.p[0] + s.p[1] + s.p[2] + s.p[3]);
  if (c.has_skew_convection)
    for (int a = 0; a < 4; ++a)
      x.Nu[a] = T.volume / 20.0 * (s.u[0] + s.u[1] + s.u[2] + s.u[3] + s.u[a]);
  return x;
}

template <class Real>
void residual_at(const Tet4Of<Real>& T, const FluidCoefficients& c, const Real& tau,
                 const Point<Real>& x, MixedResidualOf<Real>& R) {
  const Real V = T.volume;
  const Real m = V / 20.0;
  const Mat3Of<Real>& G = x.G;
  const Real div_u = G[0][0] + G[1][1] + G[2][2];
  const Vec3Of<Real> m_sum = x.m[0] + x.m[1] + x.m[2] + x.m[3];
  const Vec3Of<Real> r_sum = m_sum + 4.0 * x.h;
  Mat3Of<Real> stress;  // V (2μ ε − p̄ I)
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j)
      stress[i][j] = V * (x.mu.value * (G[i][j] + G[j][i]) - (i == j ? x.p_mean : 0.0));
  for (int a = 0; a < 4; ++a) {
    const Vec3Of<Real>& N = T.grad_N[a];
    const Real* t = x.t[a];
    for (int i = 0; i < 3; ++i) {
      // Σ_k σ_k r_k = Σ_k σ_k m_k + Σ_k σ_k h
      const Real tm = t[0] * x.m[0][i] + t[1] * x.m[1][i] + t[2] * x.m[2][i] + t[3] * x.m[3][i] +
                      x.t_sum[a] * x.h[i];
      R.u[a][i] = m * (m_sum[i] + x.m[a][i]) + dot(stress[i], N) + x.sums * x.t_sum[a] * r_sum[i] +
                  x.products * tm - x.past[a][i];
      if (c.has_skew_convection) R.u[a][i] += 0.5 * c.density * div_u * x.Nu[a][i];
    }
    R.p[a] = -0.25 * V * div_u - 0.25 * V * tau / c.density * dot(N, r_sum);
  }
}

/// A[a][b] += ½ρ [δ div u ∫N_a N_b + ∫N_a u ⊗ ∇N_b].
template <class Real>
void add_skew_convection(const Tet4Of<Real>& T, const FluidCoefficients& c, const Point<Real>& x,
                         Real A[4][4][3][3]) {
  const Real half_rho = 0.5 * c.density;
  const Real mass = half_rho * T.volume / 20.0 * (x.G[0][0] + x.G[1][1] + x.G[2][2]);
  for (int a = 0; a < 4; ++a)
    for (int b = 0; b < 4; ++b)
      for (int i = 0; i < 3; ++i) {
        A[a][b][i][i] += a == b ? 2.0 * mass : mass;
        for (int j = 0; j < 3; ++j) A[a][b][i][j] += half_rho * x.Nu[a][i] * T.grad_N[b][j];
      }
}

/// A[a][b] += 2μ' V e∇N_a ⊗ e∇N_b.
template <class Real>
void add_change_of_viscosity(const Tet4Of<Real>& T, const Point<Real>& x, Real A[4][4][3][3]) {
  const Real factor = 2.0 * x.mu.slope * T.volume;
  Mat3Of<Real> e;  // 2ε
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j) e[i][j] = x.G[i][j] + x.G[j][i];
  std::array<Vec3Of<Real>, 4> eN;
  for (int a = 0; a < 4; ++a) eN[a] = e * T.grad_N[a];
  for (int a = 0; a < 4; ++a)
    for (int b = 0; b < 4; ++b)
      for (int i = 0; i < 3; ++i)
        for (int j = 0; j < 3; ++j) A[a][b][i][j] += factor * eN[a][i] * eN[b][j];
}

template <class Real>
void momentum_block(const Tet4Of<Real>& T, const FluidCoefficients& c, const Point<Real>& x,
                    Real A[4][4][3][3]) {
  const Real V = T.volume;
  const Real m = V / 20.0;
  const Real mu_V = x.mu.value * V;
  const Vec3Of<Real> r_sum = x.m[0] + x.m[1] + x.m[2] + x.m[3] + 4.0 * x.h;
  for (int b = 0; b < 4; ++b) {
    const Vec3Of<Real>& Nb = T.grad_N[b];
    const Real* sb = x.s[b];
    Vec3Of<Real> column;  // τ ∫N_b r + μ V ∇N_b
    for (int i = 0; i < 3; ++i)
      column[i] = x.sums * r_sum[i] + x.products * (x.m[b][i] + x.h[i]) + mu_V * Nb[i];
    for (int a = 0; a < 4; ++a) {
      const Vec3Of<Real>& Na = T.grad_N[a];
      const Real* ta = x.t[a];
      const Real W =
          c.density * (m * (a == b ? 2.0 : 1.0) + x.sums * x.t_sum[a] + x.products * ta[b]);
      const Real NS = m * (x.s_sum[b] + sb[a]);
      const Real TS = x.sums * x.t_sum[a] * x.s_sum[b] +
                      x.products * (ta[0] * sb[0] + ta[1] * sb[1] + ta[2] * sb[2] + ta[3] * sb[3]);
      const Real diagonal = W * c.inv_dt + c.density * (NS + TS) + mu_V * dot(Na, Nb);
      for (int i = 0; i < 3; ++i)
        for (int j = 0; j < 3; ++j)
          A[a][b][i][j] = W * x.G[i][j] + column[i] * Na[j] + (i == j ? diagonal : 0.0);
    }
  }
  if (c.has_skew_convection) add_skew_convection(T, c, x, A);
  if (!c.viscosity->is_constant()) add_change_of_viscosity(T, x, A);
}

template <class Real>
void pressure_blocks(const Tet4Of<Real>& T, const FluidCoefficients& c, const Real& tau,
                     const Point<Real>& x, MixedJacobianOf<Real>& K) {
  const Real quarter_V = 0.25 * T.volume;
  const Real tau_q = tau * quarter_V;
  const Real tau_V_rho = tau * T.volume / c.density;
  for (int a = 0; a < 4; ++a) {
    const Vec3Of<Real>& Na = T.grad_N[a];
    Vec3Of<Real> GN;
    for (int j = 0; j < 3; ++j)
      GN[j] = tau_q * (Na[0] * x.G[0][j] + Na[1] * x.G[1][j] + Na[2] * x.G[2][j]);
    const Real ta = tau_q * x.t_sum[a];
    for (int b = 0; b < 4; ++b) {
      const Vec3Of<Real>& Nb = T.grad_N[b];
      const Real sb = tau_q * (c.inv_dt + x.s_sum[b]);
      K.mC[a][b] = -tau_V_rho * dot(Na, Nb);
      for (int j = 0; j < 3; ++j) {
        K.B1T[a][b][j] = ta * Nb[j] - quarter_V * Na[j];
        K.B2[a][b][j] = -quarter_V * Nb[j] - sb * Na[j] - GN[j];
      }
    }
  }
}

/// What all pairs of vertices share.
struct ShapePoint {
  Point<double> x;
  double V, m, mu_V, tau, div_u;
  Vec3 grad_p, m_sum, r_sum;
  Mat3 e;       ///< G + Gᵀ
  Mat3 stress;  ///< μ e − p̄ I
};

/// The derivatives by the place of vertex b that all rows share.
struct MovedVertex {
  double t[4], t_sum = 0.0;
  Vec3 stress_N, e_N;
  Vec3 t_r;  ///< τ ∫ t_b r
  double N_r;
  Vec3 log_tau;  ///< dτ/τ
};

ShapePoint shape_point(const Tet4& T, const FluidState& s, const FluidCoefficients& c, double tau) {
  ShapePoint p{};
  p.x = evaluate(T, s, c, tau);
  p.V = T.volume;
  p.m = p.V / 20.0;
  p.mu_V = p.x.mu.value * p.V;
  p.tau = tau;
  p.grad_p = p.x.h + c.density * c.inv_dt * s.subscale + s.viscous;
  p.m_sum = p.x.m[0] + p.x.m[1] + p.x.m[2] + p.x.m[3];
  p.r_sum = p.m_sum + 4.0 * p.x.h;
  p.div_u = p.x.G[0][0] + p.x.G[1][1] + p.x.G[2][2];
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j) {
      p.e[i][j] = p.x.G[i][j] + p.x.G[j][i];
      p.stress[i][j] = p.x.mu.value * p.e[i][j] - (i == j ? p.x.p_mean : 0.0);
    }
  return p;
}

MovedVertex moved_vertex(const Tet4& T, const ShapePoint& p, const FluidCoefficients& c,
                         const TauDerivative& derivative, int b) {
  const Point<double>& x = p.x;
  const Vec3& Nb = T.grad_N[b];
  MovedVertex v{};
  for (int k = 0; k < 4; ++k) v.t_sum += v.t[k] = x.s[b][k] + (k == b ? c.inv_dt : 0.0);
  v.stress_N = p.stress * Nb;
  v.e_N = p.e * Nb;
  v.t_r = x.sums * v.t_sum * p.r_sum;
  for (int k = 0; k < 4; ++k) v.t_r += x.products * v.t[k] * (x.m[k] + x.h);
  v.N_r = dot(Nb, p.r_sum);
  for (int j = 0; j < 3; ++j)
    v.log_tau[j] =
        (derivative.by_volume * Nb[j] - 0.25 * c.inv_dt * derivative.by_velocity[j]) / p.tau;
  return v;
}

/// The rows of vertex a by the place of vertex b.
void add_shape_pair(const Tet4& T, const ShapePoint& p, const FluidCoefficients& c,
                    const MovedVertex& v, int a, int b, ShapeJacobian& K) {
  const Point<double>& x = p.x;
  const Vec3 &Na = T.grad_N[a], &Nb = T.grad_N[b];
  const double* ta = x.t[a];
  const double Na_Nb = dot(Na, Nb);
  const Vec3 stress_Na = p.stress * Na, e_Na = p.e * Na;
  const double tt = x.sums * x.t_sum[a] * v.t_sum + x.products * (ta[0] * v.t[0] + ta[1] * v.t[1] +
                                                                  ta[2] * v.t[2] + ta[3] * v.t[3]);
  const double inertia = c.density * (p.m * (v.t_sum + v.t[a]) + tt) + p.mu_V * Na_Nb;
  const Vec3 galerkin = p.m * (p.m_sum + x.m[a]) + p.V * stress_Na - x.past[a];
  Vec3 streamline = x.sums * x.t_sum[a] * p.r_sum;  // τ ∫ σ_a r
  for (int k = 0; k < 4; ++k) streamline += x.products * ta[k] * (x.m[k] + x.h);
  const double tau_ta = (4.0 * x.sums + x.products) * x.t_sum[a];  // τ ∫ σ_a
  const double pspg = -0.25 * p.V * p.tau / c.density;
  const double Na_r = dot(Na, p.r_sum);
  for (int j = 0; j < 3; ++j) {
    const Vec3 Gj{x.G[0][j], x.G[1][j], x.G[2][j]};
    const double Gj_Na = dot(Gj, Na), Gj_Nb = dot(Gj, Nb);
    for (int i = 0; i < 3; ++i)
      K.u[a][b][i][j] = Nb[j] * (galerkin[i] + streamline[i]) + v.log_tau[j] * streamline[i] -
                        inertia * Gj[i] - p.mu_V * Gj_Na * Nb[i] -
                        Na[j] * (p.V * v.stress_N[i] + v.t_r[i]) - tau_ta * p.grad_p[j] * Nb[i];
    if (c.has_skew_convection)  // d(V div u) = V (∂_j N_b div u − G_j·∇N_b)
      for (int i = 0; i < 3; ++i)
        K.u[a][b][i][j] += 0.5 * c.density * (Nb[j] * p.div_u - Gj_Nb) * x.Nu[a][i];
    if (!c.viscosity->is_constant())  // V dμ e∇N_a
      for (int i = 0; i < 3; ++i)
        K.u[a][b][i][j] -= 2.0 * p.V * x.mu.slope * dot(Gj, v.e_N) * e_Na[i];
    // dΣr = −ρ t_sum G_j − 4 ∂_j p ∇N_b
    const double Na_dr = -c.density * v.t_sum * Gj_Na - 4.0 * p.grad_p[j] * Na_Nb;
    K.p[a][b][j] = -0.25 * p.V * (Nb[j] * p.div_u - Gj_Nb) +
                   pspg * ((Nb[j] + v.log_tau[j]) * Na_r - Na[j] * v.N_r + Na_dr);
  }
}

}  // namespace

void fluid_up_shape_jacobian(const Tet4& T, const FluidState& s, const FluidCoefficients& c,
                             double tau, const TauDerivative& derivative, ShapeJacobian& K) {
  const ShapePoint p = shape_point(T, s, c, tau);
  for (int b = 0; b < 4; ++b) {
    const MovedVertex v = moved_vertex(T, p, c, derivative, b);
    for (int a = 0; a < 4; ++a) add_shape_pair(T, p, c, v, a, b, K);
  }
}

Vec3 fluid_subscale(const Tet4& T, const FluidState& s, const FluidCoefficients& c, double tau) {
  const Point<double> x = evaluate(T, s, c, tau);
  // u' = −(τ/ρ) (m̄ + h)
  return -tau / c.density * (0.25 * (x.m[0] + x.m[1] + x.m[2] + x.m[3]) + x.h);
}

MixedResidual fluid_up_residual(const Tet4& T, const FluidState& s, const FluidCoefficients& c,
                                double tau) {
  MixedResidual R;
  residual_at(T, c, tau, evaluate(T, s, c, tau), R);
  return R;
}

void fluid_up_jacobian(const Tet4& T, const FluidState& s, const FluidCoefficients& c, double tau,
                       MixedResidual& R, MixedJacobian& K) {
  const Point<double> x = evaluate(T, s, c, tau);
  residual_at(T, c, tau, x, R);
  momentum_block(T, c, x, K.A);
  pressure_blocks(T, c, tau, x, K);
}

TUNICA_PACKED void fluid_up_residual(const Tet4Of<Pack>& T, const FluidStateOf<Pack>& s,
                                     const FluidCoefficients& c, const Pack& tau,
                                     MixedResidualOf<Pack>& R) {
  residual_at(T, c, tau, evaluate(T, s, c, tau), R);
}

TUNICA_PACKED void fluid_up_jacobian(const Tet4Of<Pack>& T, const FluidStateOf<Pack>& s,
                                     const FluidCoefficients& c, const Pack& tau,
                                     MixedResidualOf<Pack>& R, MixedJacobianOf<Pack>& K) {
  const Point<Pack> x = evaluate(T, s, c, tau);
  residual_at(T, c, tau, x, R);
  momentum_block(T, c, x, K.A);
  pressure_blocks(T, c, tau, x, K);
}

// The stabilisation's rows times (u, −p): the pressure's row enters the balance of energy with
// a minus, because −p div u is what it balances in the momentum's.
double fluid_stabilisation_power(const Tet4& T, const FluidState& s, const FluidCoefficients& c,
                                 double tau) {
  const Point<double> x = evaluate(T, s, c, tau);
  const Vec3 grad_p = x.h + c.density * c.inv_dt * s.subscale + s.viscous;
  Vec3 q_sum{0, 0, 0}, r_sum{0, 0, 0}, on_walls{0, 0, 0};  // Σ_a ω_a u_a/(4Δt)
  double products = 0.0, past = 0.0;
  for (int a = 0; a < 4; ++a) {
    on_walls += 0.25 * c.inv_dt * s.on_wall[a] * s.u[a];
    past += dot(s.u[a], x.past[a]);
  }
  for (int k = 0; k < 4; ++k) {
    // Σ_a σ_a u_a + ∇p/ρ
    const Vec3 q = x.G * (s.u[k] - s.w[k]) - on_walls + 1.0 / c.density * grad_p;
    const Vec3 r = x.m[k] + x.h;
    q_sum += q;
    r_sum += r;
    products += dot(q, r);
  }
  return x.sums * dot(q_sum, r_sum) + x.products * products - past;
}

}  // namespace tunica::kernels
