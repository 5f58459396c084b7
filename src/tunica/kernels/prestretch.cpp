#include "tunica/kernels/prestretch.hpp"

#include "tunica/kernels/deformation.hpp"
#include "tunica/kernels/wall_stress.hpp"

namespace tunica::kernels {

// With V, ∇N, ∇p in place, f_a = V σ∇N_a. By the change of σ alone, with F ← (I + ε) F, ε = sym ∇s,
//
//   dσ = ε σ + σ ε − (∇·s) σ + c:ε + dσ',     df_a = V dσ ∇N_a
//
// and where the element moves, with F ← (I + ∇s) F, df_a = V [∇s σ + c:ε] ∇N_a. The difference is
//
//   A[a][b] = V { ½ [(σ∇N_b) ⊗ ∇N_a + ∇N_b ⊗ (σ∇N_a) + (∇N_a·∇N_b) σ − (∇N_a·σ∇N_b) I]
//                 − (σ∇N_a) ⊗ ∇N_b } + V dσ'/ds_b ∇N_a
//
// dσ' comes from fibres, which keep the direction m that they have in place, and not the
// F⁻¹m/|F⁻¹m| that they have without stress:
//
//   dσ' = J⁻¹ F [S'(C, fibres along (F + ε F)⁻¹m) − S'(C, fibres along F⁻¹m)] Fᵀ
//
// The volume without stress is V₀ = V/J, and τ goes with V₀^⅔:
//
//   R_p[a] = −V₀/4 (J − 1 + p'/κ) − V₀/(20κ) (4 p̄ + p_a) − τ V ∇p·∇N_a,    p' = −τ_v (J − 1 + p̄/κ)
//   dR_p[a] = c_a ∇·s,
//   c_a = V₀ [−1 + (p' + τ_v J)/κ]/4 + V₀/(20κ) (4 p̄ + p_a) + ⅔ τ V ∇p·∇N_a
//
// and where the element moves
//
//   dR_p[a] = Σ_b s_b·{−V/4 (1 − τ_v/κ) ∇N_b
//                      − τ V [(∇p·∇N_a) ∇N_b − (∇N_a·∇N_b) ∇p − (∇p·∇N_b) ∇N_a]}

namespace {

double mean_pressure(const PrestretchedElement& element) {
  return 0.25 * (element.p[0] + element.p[1] + element.p[2] + element.p[3]);
}

/// p'
double pressure_subscale(const PrestretchedElement& element) {
  const double J = element.in_place.volume / element.stress_free.volume;
  const SolidCoefficients& c = element.coefficients;
  return -c.tau_v * (J - 1.0 + c.inv_kappa * mean_pressure(element));
}

Mat3 full(const Sym3& s) { return {{{s[0], s[3], s[5]}, {s[3], s[1], s[4]}, {s[5], s[4], s[2]}}}; }

void stress_in_place(const PrestretchedElement& element, MixedJacobian& K) {
  const Tet4& T = element.in_place;
  Mat3 sigma =
      full(cauchy_stress(element.stress_free, element.d, element.p, *element.law, element.frame));
  for (int i = 0; i < 3; ++i) sigma[i][i] -= pressure_subscale(element);
  for (int a = 0; a < 4; ++a) {
    const Vec3& N_a = T.grad_N[a];
    const Vec3 f = T.volume * (sigma * N_a);
    for (int b = 0; b < 4; ++b) {
      const Vec3& N_b = T.grad_N[b];
      const Vec3 g = T.volume * (sigma * N_b);
      const double normals = T.volume * dot(N_a, N_b);
      for (int i = 0; i < 3; ++i) {
        const Vec3 row = 0.5 * (g[i] * N_a + N_b[i] * f + normals * sigma[i]) - f[i] * N_b;
        for (int j = 0; j < 3; ++j) K.A[a][b][i][j] += row[j];
        K.A[a][b][i][i] -= 0.5 * dot(f, N_b);
      }
    }
  }
}

/// dσ' by ε = ½ (e_m⊗e_n + e_n⊗e_m), by central differences: laws give no derivative by the frame.
Mat3 stress_of_turned_fibres(const PrestretchedElement& element, const Mat3& F, int m, int n) {
  constexpr double h = 1e-5;
  const Sym3 C = right_cauchy_green(F);
  Sym3 dS{};
  for (const double side : {1.0, -1.0}) {
    Mat3 stretched = F;
    stretched[m] += 0.5 * side * h * F[n];
    stretched[n] += 0.5 * side * h * F[m];
    const Sym3 S =
        element.law->stress(C, materials::pulled_back(element.frame_in_place, stretched), {});
    for (std::size_t I = 0; I < S.size(); ++I) dS[I] += side * S[I] / (2.0 * h);
  }
  Mat3 result = F * full(dS) * transpose(F);
  for (Vec3& row : result) row = 1.0 / det(F) * row;
  return result;
}

void fibres_in_place(const PrestretchedElement& element, MixedJacobian& K) {
  const Tet4& T = element.in_place;
  const Mat3 F = deformation_gradient(element.stress_free, element.d);
  for (int m = 0; m < 3; ++m)
    for (int n = m; n < 3; ++n) {
      const Mat3 stress = stress_of_turned_fibres(element, F, m, n);
      for (int a = 0; a < 4; ++a) {
        const Vec3 f = T.volume * (stress * T.grad_N[a]);
        for (int b = 0; b < 4; ++b)  // ε_mn + ε_nm of s_b = e_m is N_b,n, of e_n is N_b,m
          for (int i = 0; i < 3; ++i) {
            K.A[a][b][i][m] += f[i] * T.grad_N[b][n];
            if (m != n) K.A[a][b][i][n] += f[i] * T.grad_N[b][m];
          }
      }
    }
}

void volume_in_place(const PrestretchedElement& element, MixedJacobian& K) {
  const Tet4& T = element.in_place;
  const SolidCoefficients& c = element.coefficients;
  const double V = T.volume, V0 = element.stress_free.volume, J = V / V0;
  const double p_mean = mean_pressure(element), p_sub = pressure_subscale(element);
  const double tau_V = c.tau * V;
  Vec3 grad_p{0, 0, 0};
  for (int a = 0; a < 4; ++a) grad_p += element.p[a] * T.grad_N[a];
  for (int a = 0; a < 4; ++a) {
    const Vec3& N_a = T.grad_N[a];
    const double in_place = 0.25 * V0 * (-1.0 + c.inv_kappa * (p_sub + c.tau_v * J)) +
                            V0 / 20.0 * c.inv_kappa * (4.0 * p_mean + element.p[a]) +
                            2.0 / 3.0 * tau_V * dot(grad_p, N_a);
    const double moving = -0.25 * V * (1.0 - c.tau_v * c.inv_kappa) - tau_V * dot(grad_p, N_a);
    for (int b = 0; b < 4; ++b) {
      const Vec3& N_b = T.grad_N[b];
      const Vec3 row = (in_place - moving) * N_b - tau_V * dot(N_a, N_b) * grad_p -
                       tau_V * dot(grad_p, N_b) * N_a;
      for (int j = 0; j < 3; ++j) K.B2[a][b][j] = row[j];
    }
  }
}

}  // namespace

MixedJacobian prestretch_jacobian(const PrestretchedElement& element) {
  MixedJacobian K{};
  stress_in_place(element, K);
  if (element.law->has_fibres()) fibres_in_place(element, K);
  volume_in_place(element, K);
  return K;
}

}  // namespace tunica::kernels
