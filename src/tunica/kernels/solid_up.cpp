#include "tunica/kernels/solid_up.hpp"

#include "tunica/base/error.hpp"
#include "tunica/kernels/deformation.hpp"

namespace tunica::kernels {

// The P1–P1 mixed solid with PSPG on one tetrahedron of the reference configuration.
//
//   R_u[a] = ∫ N_a (α d − r) + P ∇N_a dV,               P = F S' − (p + p') J F⁻ᵀ
//   R_p[a] = −∫ N_a (J − 1 + (p + p')/κ) dV − τ ∫ s·g_a dV,    s = α d − r − r' + J F⁻ᵀ∇p
//
//   F    I + Σ_a d_a ⊗ ∇N_a, constant        1        J   det F, positive          1
//   S'   law.stress, isochoric PK2           kPa      κ   bulk modulus             kPa
//   p    nodal, compression positive         kPa      τ   PSPG parameter           mm²/kPa
//   α    ρ/(βΔt²), zero in statics           kPa/mm²  r   inertia history, force   kPa/mm
//   g_a  F⁻ᵀ∇N_a, spatial gradient           1/mm     r'  history of the subscale   kPa/mm
//
// The subscale d' is what the mesh does not resolve of the displacement, a vector per element with
// the inertia of the wall where it is time-dependent (r' = 0 otherwise), at fixed 1/τ = 4μ/h² + α:
//
//   α d' − r' + (4μ/h²) d' = −mean(α d − r + J F⁻ᵀ∇p),   hence   d' = −τ s̄
//
// The volumetric subscale p' is what the mesh does not resolve of the pressure, a number per
// element:
//
//   p' = −τ_v θ,   θ = J − 1 + p̄/κ,     the derivative of   V τ_v/2 θ²
//
// The nodal pressures hold the volume of patches only, and elements of a patch may trade theirs:
// where p varies over a patch by more than μ that lowers the energy. τ_v of the size of μ ends it
// and does not lock, see verify/test_block.cpp.
//
// Every integral is exact: the integrands are at most quadratic on the element.
// The Jacobian is exact, with the derivative of the PSPG term:
//
//   A[a][b]     = α M_ab I + V [(∇N_a·S'∇N_b) I + B_aᵀ D B_b]
//                 − (p̄ + p') J V (g_a⊗g_b − g_b⊗g_a) + τ_v J² V g_a⊗g_b
//   B1ᵀ[a][b]   = −V J/4 (1 − τ_v/κ) g_a
//   B2[a][b]    = −V J/4 (1 − τ_v/κ) g_b
//                 − τ V [α/4 g_a + J (g_p·g_a) g_b − J (g_a·g_b) g_p − (s̄·g_b) g_a]
//   −C[a][b]    = −M_ab/κ + τ_v V/(16 κ²) − τ V J g_a·g_b
//
//   M_ab  V/20 (1 + δ_ab)       g_p  F⁻ᵀ∇p       B_b  dE/dd_b in Voigt's order
//   D     dS'/dE                bar  mean of the four nodal values
//   τ_v   of the volumetric subscale, kPa
//
// Source: [LY1] eq:weakelas, eq:stelas; ours: p'.
// Deviation: [LY1] prints τ without inertia; τ is an argument here, problems/ chooses.

namespace {

template <class Real>
struct Point {
  Mat3Of<Real> F;
  Sym3Of<Real> C;
  Real J;
  Real p_mean;
  Real p_sub;         ///< p'
  Vec3Of<Real> g[4];  ///< F⁻ᵀ∇N_a
  Vec3Of<Real> g_p;   ///< F⁻ᵀ∇p
  Vec3Of<Real> q[4];  ///< α d_a − r_a
  Vec3Of<Real> s;     ///< mean of q + J g_p − r'
};

template <class Real>
Point<Real> evaluate(const Tet4Of<Real>& T, const SolidStateOf<Real>& s,
                     const SolidCoefficientsOf<Real>& c) {
  Point<Real> x;
  x.F = deformation_gradient(T, s.d);
  x.C = right_cauchy_green(x.F);
  const Mat3Of<Real> adj = adjugate(x.F);
  x.J = x.F[0][0] * adj[0][0] + x.F[0][1] * adj[1][0] + x.F[0][2] * adj[2][0];
  TUNICA_ASSERT(all_greater(x.J, Real(0.0)), "inverted element reached the solid kernel");
  const Real inv_J = 1.0 / x.J;
  x.g_p = {0, 0, 0};
  Vec3Of<Real> q_sum{0, 0, 0};
  for (int a = 0; a < 4; ++a) {
    const Vec3Of<Real>& N = T.grad_N[a];
    for (int i = 0; i < 3; ++i) {
      x.g[a][i] = inv_J * (adj[0][i] * N[0] + adj[1][i] * N[1] + adj[2][i] * N[2]);
      x.g_p[i] += s.p[a] * x.g[a][i];
      x.q[a][i] = c.alpha * s.d[a][i] - s.r[a][i];
      q_sum[i] += x.q[a][i];
    }
  }
  x.p_mean = 0.25 * (s.p[0] + s.p[1] + s.p[2] + s.p[3]);
  x.p_sub = -c.tau_v * (x.J - 1.0 + c.inv_kappa * x.p_mean);
  for (int i = 0; i < 3; ++i) x.s[i] = 0.25 * q_sum[i] - s.subscale_r[i] + x.J * x.g_p[i];
  return x;
}

template <class Real>
void residual_at(const Tet4Of<Real>& T, const SolidStateOf<Real>& s,
                 const SolidCoefficientsOf<Real>& c, const Point<Real>& x, const Sym3Of<Real>& S,
                 MixedResidualOf<Real>& R) {
  const Real V = T.volume;
  const Real m = V / 20.0;
  const Real pJV = (x.p_mean + x.p_sub) * x.J * V;
  const Vec3Of<Real> q_sum = x.q[0] + x.q[1] + x.q[2] + x.q[3];
  for (int a = 0; a < 4; ++a) {
    const Vec3Of<Real> FSN = x.F * apply(S, T.grad_N[a]);
    for (int i = 0; i < 3; ++i)
      R.u[a][i] = m * (q_sum[i] + x.q[a][i]) + V * FSN[i] - pJV * x.g[a][i];
    R.p[a] = -0.25 * V * (x.J - 1.0 + c.inv_kappa * x.p_sub) -
             c.inv_kappa * m * (4.0 * x.p_mean + s.p[a]) - c.tau * V * dot(x.s, x.g[a]);
  }
}

/// B[I][3a+k] = dE_I / dd_a[k] for the first three vertices, engineering shears.
template <class Real>
void strain_operator(const Tet4Of<Real>& T, const Mat3Of<Real>& F, Real B[6][9]) {
  for (int a = 0; a < 3; ++a) {
    const Vec3Of<Real>& N = T.grad_N[a];
    for (int k = 0; k < 3; ++k) {
      B[0][3 * a + k] = F[k][0] * N[0];
      B[1][3 * a + k] = F[k][1] * N[1];
      B[2][3 * a + k] = F[k][2] * N[2];
      B[3][3 * a + k] = F[k][0] * N[1] + F[k][1] * N[0];
      B[4][3 * a + k] = F[k][1] * N[2] + F[k][2] * N[1];
      B[5][3 * a + k] = F[k][2] * N[0] + F[k][0] * N[2];
    }
  }
}

/// H = V Bᵀ D B, upper triangle by rows of three.
template <class Real>
void material_tangent(const Real& V, const Real B[6][9], const Sym3MapOf<Real>& D, Real H[9][9]) {
  Real DB[6][9];
  for (int I = 0; I < 6; ++I)
    for (int n = 0; n < 9; ++n) {
      Real sum = 0.0;
      for (int J = 0; J < 6; ++J) sum += D[I][J] * B[J][n];
      DB[I][n] = V * sum;
    }
  for (int m = 0; m < 9; ++m)
    for (int n = 3 * (m / 3); n < 9; ++n) {
      Real sum = 0.0;
      for (int I = 0; I < 6; ++I) sum += B[I][m] * DB[I][n];
      H[m][n] = sum;
    }
}

/// The stiffness depends on the vertices through F alone, hence its rows and columns add up
/// to zero over the vertices: three are computed, the fourth follows. Mass comes on top.
template <class Real>
void stiffness_block(const Tet4Of<Real>& T, const Point<Real>& x,
                     const materials::StressTangentOf<Real>& law,
                     const SolidCoefficientsOf<Real>& c, Real A[4][4][3][3]) {
  const Real V = T.volume;
  const Real pJV = (x.p_mean + x.p_sub) * x.J * V;
  const Real outer = c.tau_v * x.J * x.J * V - pJV;  // of g_a⊗g_b
  Real B[6][9];
  Real H[9][9];
  strain_operator(T, x.F, B);
  material_tangent(V, B, law.D, H);
  for (int a = 0; a < 3; ++a) {
    const Vec3Of<Real> SN = apply(law.S, T.grad_N[a]);
    const Vec3Of<Real> along = outer * x.g[a], across = pJV * x.g[a];
    for (int b = a; b < 3; ++b) {
      const Real geometric = V * dot(SN, T.grad_N[b]);
      for (int i = 0; i < 3; ++i)
        for (int j = 0; j < 3; ++j) {
          const Real value = H[3 * a + i][3 * b + j] + (i == j ? geometric : 0.0) +
                             along[i] * x.g[b][j] + x.g[b][i] * across[j];
          A[a][b][i][j] = value;
          A[b][a][j][i] = value;
        }
    }
  }
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j) {
      for (int a = 0; a < 3; ++a) {
        const Real value = -(A[a][0][i][j] + A[a][1][i][j] + A[a][2][i][j]);
        A[a][3][i][j] = value;
        A[3][a][j][i] = value;
      }
    }
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j) A[3][3][i][j] = -(A[0][3][i][j] + A[1][3][i][j] + A[2][3][i][j]);
  const Real m = c.alpha * V / 20.0;
  for (int a = 0; a < 4; ++a)
    for (int b = 0; b < 4; ++b)
      for (int i = 0; i < 3; ++i) A[a][b][i][i] += a == b ? 2.0 * m : m;
}

template <class Real>
void pressure_blocks(const Tet4Of<Real>& T, const Point<Real>& x,
                     const SolidCoefficientsOf<Real>& c, MixedJacobianOf<Real>& K) {
  const Real V = T.volume;
  const Real tau_V = c.tau * V;
  const Real tau_VJ = tau_V * x.J;
  const Real quarter_VJ = 0.25 * V * x.J;
  const Real m = c.inv_kappa * V / 20.0;
  const Real coupling = quarter_VJ * (1.0 - c.tau_v * c.inv_kappa);
  const Real volumetric = c.tau_v * V * (0.25 * c.inv_kappa) * (0.25 * c.inv_kappa);
  Real sg[4];
  Real pg[4];
  for (int a = 0; a < 4; ++a) {
    sg[a] = tau_V * (0.25 * c.alpha - dot(x.s, x.g[a]));
    pg[a] = coupling + tau_VJ * dot(x.g_p, x.g[a]);
  }
  for (int a = 0; a < 4; ++a)
    for (int b = 0; b < 4; ++b) {
      const Real gg = tau_VJ * dot(x.g[a], x.g[b]);
      K.mC[a][b] = -(a == b ? 2.0 * m : m) + volumetric - gg;
      for (int j = 0; j < 3; ++j) {
        K.B1T[a][b][j] = -coupling * x.g[a][j];
        K.B2[a][b][j] = gg * x.g_p[j] - pg[a] * x.g[b][j] - sg[b] * x.g[a][j];
      }
    }
}

}  // namespace

double solid_jacobian_determinant(const Tet4& T, const std::array<Vec3, 4>& d) {
  return det(deformation_gradient(T, d));
}

Vec3 solid_subscale(const Tet4& T, const SolidState& s, const SolidCoefficients& c) {
  return -c.tau * evaluate(T, s, c).s;  // d' = −τ s̄
}

MixedResidual solid_up_residual(const Tet4& T, const SolidState& s, const LawAtElement& at,
                                const SolidCoefficients& c) {
  const Point<double> x = evaluate(T, s, c);
  MixedResidual R;
  residual_at(T, s, c, x, at.law->stress(x.C, at.frame, at.past), R);
  return R;
}

void solid_up_jacobian(const Tet4& T, const SolidState& s, const LawAtElement& at,
                       const SolidCoefficients& c, MixedResidual& R, MixedJacobian& K) {
  const Point<double> x = evaluate(T, s, c);
  const materials::StressTangent response = at.law->response(x.C, at.frame, at.past);
  residual_at(T, s, c, x, response.S, R);
  stiffness_block(T, x, response, c, K.A);
  pressure_blocks(T, x, c, K);
}

namespace {

// One law at all points, and where another holds its values in the place of those.

Sym3Of<Pack> stress_of(const PackedLaws& at, const Sym3Of<Pack>& C) {
  Sym3Of<Pack> S = at.laws[0]->packed_stress(C, at.frames, at.pasts);
  for (int lane = 1; lane < Pack::size; ++lane)
    if (at.laws[lane] != at.laws[0]) {
      const Sym3Of<Pack> other = at.laws[lane]->packed_stress(C, at.frames, at.pasts);
      set_lane(S, lane, lane_of(other, lane));
    }
  return S;
}

materials::StressTangentOf<Pack> response_of(const PackedLaws& at, const Sym3Of<Pack>& C) {
  materials::StressTangentOf<Pack> response = at.laws[0]->packed_response(C, at.frames, at.pasts);
  for (int lane = 1; lane < Pack::size; ++lane)
    if (at.laws[lane] != at.laws[0]) {
      const auto other = at.laws[lane]->packed_response(C, at.frames, at.pasts);
      set_lane(response.S, lane, lane_of(other.S, lane));
      set_lane(response.D, lane, lane_of(other.D, lane));
    }
  return response;
}

}  // namespace

TUNICA_PACKED void solid_up_residual(const Tet4Of<Pack>& T, const SolidStateOf<Pack>& s,
                                     const PackedLaws& laws, const SolidCoefficientsOf<Pack>& c,
                                     MixedResidualOf<Pack>& R) {
  const Point<Pack> x = evaluate(T, s, c);
  residual_at(T, s, c, x, stress_of(laws, x.C), R);
}

TUNICA_PACKED void solid_up_jacobian(const Tet4Of<Pack>& T, const SolidStateOf<Pack>& s,
                                     const PackedLaws& laws, const SolidCoefficientsOf<Pack>& c,
                                     MixedResidualOf<Pack>& R, MixedJacobianOf<Pack>& K) {
  const Point<Pack> x = evaluate(T, s, c);
  const materials::StressTangentOf<Pack> response = response_of(laws, x.C);
  residual_at(T, s, c, x, response.S, R);
  stiffness_block(T, x, response, c, K.A);
  pressure_blocks(T, x, c, K);
}

}  // namespace tunica::kernels
