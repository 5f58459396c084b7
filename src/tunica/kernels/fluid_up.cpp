#include "tunica/kernels/fluid_up.hpp"

namespace tunica::kernels {

// The P1–P1 SUPG/PSPG fluid on one tetrahedron of the current mesh, non-conservative ALE.
//
//   R_u[a] = ∫ N_a m + 2μ ε(u)∇N_a − p ∇N_a dV + τ ∫ s_a (m + h) dV
//   R_p[a] = −∫ N_a div u dV − (τ/ρ) ∫ ∇N_a·(m + h) dV
//   m      = ρ ((u − u_old)/Δt + G c − f),   c = u − w,   s_a = c·∇N_a
//   h      = ∇p − ρ ũ'/Δt − q
//
//   u, u_old  velocity, that of the last step   mm/ms    ρ  density     mg/mm³
//   w         mesh velocity                     mm/ms    μ  viscosity   kPa ms
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
// Its inertia in the momentum rows is left out.
//
// m, c and s_a are linear on the element; integrals of products are exact by
// ∫ f g = V/20 (Σf Σg + Σ_k f_k g_k). The Jacobian is exact at fixed τ, with full convective
// derivative and the derivative of the test function s_a:
//
//   A[a][b]   = δ {ρ [W_ab/Δt + ∫(N_a + τ s_a) s_b] + μ V ∇N_a·∇N_b} + ρ W_ab G
//               + (τ ∫N_b (m + h) + μ V ∇N_b) ⊗ ∇N_a,     W_ab = ∫ (N_a + τ s_a) N_b
//   B1ᵀ[a][b] = −V/4 ∇N_a + τ V s̄_a ∇N_b
//   B2[a][b]  = −V/4 ∇N_b − τ V [(1/(4Δt) + s̄_b) ∇N_a + Gᵀ∇N_a/4]
//   −C[a][b]  = −(τ/ρ) V ∇N_a·∇N_b
//
// Source: [LY1] eq:weakns, written without the inlet term (surface_tri3.hpp); [CPGB07] for the
// subscales in time.
// Deviation: [LY1] names SUPG/PSPG without its terms; these are the residual-based ones of P1,
// where the viscous part of the strong residual vanishes, so that q is zero or reconstructed from
// the neighbours of the element (assembly/viscous_residual.hpp) and known beforehand.

namespace {

struct Point {
  Mat3 G;
  Vec3 h;
  Vec3 m[4];
  double s[4][4];   ///< s[a][k], value of s_a at vertex k
  double s_sum[4];  ///< Σ_k s[a][k]
  double p_mean;
};

Point evaluate(const Tet4& T, const FluidState& s, const FluidCoefficients& c) {
  Point x;
  x.G = {};
  x.h = -c.density * c.inv_dt * s.subscale - s.viscous;
  for (int a = 0; a < 4; ++a)
    for (int j = 0; j < 3; ++j) {
      x.h[j] += s.p[a] * T.grad_N[a][j];
      for (int i = 0; i < 3; ++i) x.G[i][j] += s.u[a][i] * T.grad_N[a][j];
    }
  for (int a = 0; a < 4; ++a) x.s_sum[a] = 0.0;
  for (int k = 0; k < 4; ++k) {
    const Vec3 v = s.u[k] - s.w[k];
    for (int a = 0; a < 4; ++a) {
      x.s[a][k] = dot(v, T.grad_N[a]);
      x.s_sum[a] += x.s[a][k];
    }
    for (int i = 0; i < 3; ++i)
      x.m[k][i] = c.density * ((s.u[k][i] - s.u_old[k][i]) * c.inv_dt + dot(x.G[i], v) - s.f[k][i]);
  }
  x.p_mean = 0.25 * (s.p[0] + s.p[1] + s.p[2] + s.p[3]);
  return x;
}

void residual_at(const Tet4& T, const FluidCoefficients& c, double tau, const Point& x,
                 MixedResidual& R) {
  const double V = T.volume;
  const double m = V / 20.0;
  const Mat3& G = x.G;
  const double div_u = G[0][0] + G[1][1] + G[2][2];
  const Vec3 m_sum = x.m[0] + x.m[1] + x.m[2] + x.m[3];
  const Vec3 r_sum = m_sum + 4.0 * x.h;
  Mat3 stress;  // V (2μ ε − p̄ I)
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j)
      stress[i][j] = V * (c.viscosity * (G[i][j] + G[j][i]) - (i == j ? x.p_mean : 0.0));
  for (int a = 0; a < 4; ++a) {
    const Vec3& N = T.grad_N[a];
    const double* s = x.s[a];
    for (int i = 0; i < 3; ++i) {
      // Σ_k s_k r_k = Σ_k s_k m_k + Σ_k s_k h
      const double sm = s[0] * x.m[0][i] + s[1] * x.m[1][i] + s[2] * x.m[2][i] + s[3] * x.m[3][i] +
                        x.s_sum[a] * x.h[i];
      R.u[a][i] =
          m * (m_sum[i] + x.m[a][i]) + dot(stress[i], N) + tau * m * (x.s_sum[a] * r_sum[i] + sm);
    }
    R.p[a] = -0.25 * V * div_u - 0.25 * V * tau / c.density * dot(N, r_sum);
  }
}

void momentum_block(const Tet4& T, const FluidCoefficients& c, double tau, const Point& x,
                    double A[4][4][3][3]) {
  const double V = T.volume;
  const double m = V / 20.0;
  const double tau_m = tau * m;
  const double mu_V = c.viscosity * V;
  const Vec3 r_sum = x.m[0] + x.m[1] + x.m[2] + x.m[3] + 4.0 * x.h;
  for (int b = 0; b < 4; ++b) {
    const Vec3& Nb = T.grad_N[b];
    const double* sb = x.s[b];
    Vec3 column;  // τ ∫N_b r + μ V ∇N_b
    for (int i = 0; i < 3; ++i) column[i] = tau_m * (r_sum[i] + x.m[b][i] + x.h[i]) + mu_V * Nb[i];
    for (int a = 0; a < 4; ++a) {
      const Vec3& Na = T.grad_N[a];
      const double* sa = x.s[a];
      const double W = c.density * (m * (a == b ? 2.0 : 1.0) + tau_m * (x.s_sum[a] + sa[b]));
      const double NS = m * (x.s_sum[b] + sb[a]);
      const double SS = tau_m * (x.s_sum[a] * x.s_sum[b] + sa[0] * sb[0] + sa[1] * sb[1] +
                                 sa[2] * sb[2] + sa[3] * sb[3]);
      const double diagonal = W * c.inv_dt + c.density * (NS + SS) + mu_V * dot(Na, Nb);
      for (int i = 0; i < 3; ++i)
        for (int j = 0; j < 3; ++j)
          A[a][b][i][j] = W * x.G[i][j] + column[i] * Na[j] + (i == j ? diagonal : 0.0);
    }
  }
}

void pressure_blocks(const Tet4& T, const FluidCoefficients& c, double tau, const Point& x,
                     MixedJacobian& K) {
  const double quarter_V = 0.25 * T.volume;
  const double tau_q = tau * quarter_V;
  const double tau_V_rho = tau * T.volume / c.density;
  for (int a = 0; a < 4; ++a) {
    const Vec3& Na = T.grad_N[a];
    Vec3 GN;
    for (int j = 0; j < 3; ++j)
      GN[j] = tau_q * (Na[0] * x.G[0][j] + Na[1] * x.G[1][j] + Na[2] * x.G[2][j]);
    const double sa = tau_q * x.s_sum[a];
    for (int b = 0; b < 4; ++b) {
      const Vec3& Nb = T.grad_N[b];
      const double sb = tau_q * (c.inv_dt + x.s_sum[b]);
      K.mC[a][b] = -tau_V_rho * dot(Na, Nb);
      for (int j = 0; j < 3; ++j) {
        K.B1T[a][b][j] = sa * Nb[j] - quarter_V * Na[j];
        K.B2[a][b][j] = -quarter_V * Nb[j] - sb * Na[j] - GN[j];
      }
    }
  }
}

}  // namespace

double fluid_tau(const Tet4& T, const Vec3& velocity, const FluidCoefficients& c) {
  const double inv_h = 1.0 / element_length(T.volume);
  const double diffusive = c.viscous_factor * c.viscosity / c.density * inv_h * inv_h;
  const double convective2 = 4.0 * dot(velocity, velocity) * inv_h * inv_h;
  if (c.has_dynamic_subscales)
    return 1.0 / (c.inv_dt + std::sqrt(convective2 + diffusive * diffusive));
  const double transient = 2.0 * c.inv_dt;
  return 1.0 / std::sqrt(transient * transient + convective2 + diffusive * diffusive);
}

Vec3 fluid_subscale(const Tet4& T, const FluidState& s, const FluidCoefficients& c, double tau) {
  const Point x = evaluate(T, s, c);
  // u' = −(τ/ρ) (m̄ + h)
  return -tau / c.density * (0.25 * (x.m[0] + x.m[1] + x.m[2] + x.m[3]) + x.h);
}

MixedResidual fluid_up_residual(const Tet4& T, const FluidState& s, const FluidCoefficients& c,
                                double tau) {
  MixedResidual R;
  residual_at(T, c, tau, evaluate(T, s, c), R);
  return R;
}

void fluid_up_jacobian(const Tet4& T, const FluidState& s, const FluidCoefficients& c, double tau,
                       MixedResidual& R, MixedJacobian& K) {
  const Point x = evaluate(T, s, c);
  residual_at(T, c, tau, x, R);
  momentum_block(T, c, tau, x, K.A);
  pressure_blocks(T, c, tau, x, K);
}

// The stabilisation's rows times (u, −p): the pressure's row enters the balance of energy with
// a minus, because −p div u is what it balances in the momentum's.
double fluid_stabilisation_power(const Tet4& T, const FluidState& s, const FluidCoefficients& c,
                                 double tau) {
  const Point x = evaluate(T, s, c);
  const Vec3 grad_p = x.h + c.density * c.inv_dt * s.subscale + s.viscous;
  Vec3 q_sum{0, 0, 0}, r_sum{0, 0, 0};
  double products = 0.0;
  for (int k = 0; k < 4; ++k) {
    const Vec3 q = x.G * (s.u[k] - s.w[k]) + 1.0 / c.density * grad_p;
    const Vec3 r = x.m[k] + x.h;
    q_sum += q;
    r_sum += r;
    products += dot(q, r);
  }
  return tau * T.volume / 20.0 * (dot(q_sum, r_sum) + products);
}

}  // namespace tunica::kernels
