#pragma once
#include "oracle/algebra.hpp"
#include "oracle/quadrature.hpp"

namespace tunica::oracle {

/// μ∞ + (μ₀ − μ∞) (1 + (λγ̇)^a)^((n − 1)/a).
struct Thinning {
  double at_rest, at_high_rates, time, power, sharpness;  ///< μ₀, μ∞, λ, n, a

  template <class S>
  S at(const Mat<S>& grad_u) const {
    using std::pow;
    S squares = 0.0;  // 2 ε:ε
    for (int k = 0; k < 3; ++k)
      for (int l = 0; l < 3; ++l) {
        const S strain = 0.5 * (grad_u[k][l] + grad_u[l][k]);
        squares += 2.0 * strain * strain;
      }
    if (power == 1.0) return S(at_high_rates);
    const S s = 1.0 + pow(time * pow(squares, 0.5), sharpness);
    return at_high_rates + (at_rest - at_high_rates) * pow(s, (power - 1.0) / sharpness);
  }
};

/// Data of the ALE fluid on one tetrahedron; unknowns are numbered 3 a + i, then 12 + a. G: of what
/// depends on the mesh.
template <class G>
struct FluidWeakFormOn {
  ElementOf<G> T;
  double density;
  Thinning viscosity;
  double inv_dt;
  G tau;
  std::array<Vec<double>, 4> u_old;
  std::array<Vec<G>, 4> w;
  std::array<Vec<double>, 4> f;
  Vec<double> subscale;             ///< of the past
  Vec<double> viscous;              ///< div 2με
  std::array<double, 4> on_wall{};  ///< 1 where v has the inertia of the subscale, too
  bool is_skew = false;             ///< convection has ρ/2 (div u) u beside it
  bool is_mean = false;             ///< SUPG has its factors at the centroid

  /// All sixteen rows of
  ///   (ρ(∂u + c·∇u − f), v) + (2μ(ε) ε(u), ε(v)) − (p, div v) − (q, div u)
  ///   + τ (c·∇v − ∇q/ρ, ρ(∂u + c·∇u − f) + ∇p − ρ ũ'/Δt − div 2με),   c = u − w,
  /// and + ρ/2 ((div u) u, v) where convection is skew-symmetric, + (ρ (u' − ũ')/Δt, v) on walls
  /// with u' = −(τ/ρ) times the mean of what τ has at its right.
  template <class S>
  std::array<S, 16> residual(const std::array<S, 16>& x) const {
    std::array<Vec<S>, 4> u;
    for (int a = 0; a < 4; ++a)
      for (int i = 0; i < 3; ++i) u[a][i] = x[3 * a + i];
    std::array<S, 16> R;
    for (S& row : R) row = 0.0;
    for (const TetPoint& q : tet_rule()) {
      const G dV = q.weight * T.volume;
      const Mat<S> grad_u = gradient(u, T.grad_N);
      const S mu = viscosity.at(grad_u);
      const Vec<S> u_q = at(q.N, u);
      S p = 0.0;
      Vec<S> grad_p{S(0.0), S(0.0), S(0.0)};
      for (int a = 0; a < 4; ++a) {
        p += q.N[a] * x[12 + a];
        for (int j = 0; j < 3; ++j) grad_p[j] += x[12 + a] * T.grad_N[a][j];
      }
      const auto inertia_at = [&](const auto& N) {
        const Vec<S> u_N = at(N, u);
        const Vec<G> w_N = at(N, w);
        const Vec<double> u_old_N = at(N, u_old), f_N = at(N, f);
        Vec<S> inertia;
        for (int i = 0; i < 3; ++i) {
          S convection = 0.0;
          for (int j = 0; j < 3; ++j) convection += (u_N[j] - w_N[j]) * grad_u[i][j];
          inertia[i] = density * ((u_N[i] - u_old_N[i]) * inv_dt + convection - f_N[i]);
        }
        return inertia;
      };
      const auto point = is_mean ? decltype(q.N){0.25, 0.25, 0.25, 0.25} : q.N;  // of SUPG
      const Vec<S> u_s = at(point, u), inertia = inertia_at(q.N);
      const Vec<G> w_s = at(point, w);
      Vec<S> strong = inertia_at(point);
      for (int i = 0; i < 3; ++i)
        strong[i] += grad_p[i] - density * subscale[i] * inv_dt - viscous[i];
      for (int a = 0; a < 4; ++a) {
        S stream = 0.0;  // c·∇N_a
        for (int j = 0; j < 3; ++j) stream += (u_s[j] - w_s[j]) * T.grad_N[a][j];
        for (int i = 0; i < 3; ++i) {
          if (is_skew)
            R[3 * a + i] +=
                dV * q.N[a] * 0.5 * density * u_q[i] * (grad_u[0][0] + grad_u[1][1] + grad_u[2][2]);
          S row = inertia[i] * q.N[a] - p * T.grad_N[a][i] + tau * stream * strong[i];
          for (int k = 0; k < 3; ++k)
            for (int l = 0; l < 3; ++l) {
              // v = N_a e_i: ∂v_k/∂x_l
              const G vkl = k == i ? T.grad_N[a][l] : G(0.0);
              const G vlk = l == i ? T.grad_N[a][k] : G(0.0);
              const S strain = 0.5 * (grad_u[k][l] + grad_u[l][k]);
              row += 2.0 * mu * strain * (0.5 * (vkl + vlk));
            }
          row += 0.25 * on_wall[a] * inv_dt * (-tau * strong[i] - density * subscale[i]);
          R[3 * a + i] += dV * row;
          R[12 + a] -= dV * tau / density * strong[i] * T.grad_N[a][i];
        }
        R[12 + a] -= dV * q.N[a] * (grad_u[0][0] + grad_u[1][1] + grad_u[2][2]);
      }
    }
    return R;
  }
};
using FluidWeakForm = FluidWeakFormOn<double>;

}  // namespace tunica::oracle
