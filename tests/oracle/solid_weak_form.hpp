#pragma once
#include "oracle/algebra.hpp"
#include "oracle/quadrature.hpp"

namespace tunica::oracle {

/// Data of the mixed solid on one tetrahedron; unknowns are numbered 3 a + i, then 12 + a.
template <class Energy>
struct SolidWeakForm {
  Element T;
  Energy energy;
  double alpha, inv_kappa, tau;
  std::array<Vec<double>, 4> r;
  Vec<double> subscale_r;
  double tau_v = 0.0;

  /// Π = ∫ α/2 |d|² − r·d + Ψ'(C) − p (J − 1) − p²/(2κ) + τ_v/2 (J − 1 + p̄/κ)² dV.
  template <class S>
  S potential(const std::array<S, 16>& x) const {
    const std::array<Vec<S>, 4> d = displacement(x);
    const S p_mean = 0.25 * (x[12] + x[13] + x[14] + x[15]);
    S total = 0.0;
    for (const TetPoint& q : tet_rule()) {
      const Mat<S> F = deformation(d);
      const Vec<S> d_q = at(q.N, d);
      const Vec<double> r_q = at(q.N, r);
      S p = 0.0;
      for (int a = 0; a < 4; ++a) p += q.N[a] * x[12 + a];
      S density = energy(gram(F)) - p * (determinant(F) - 1.0) - 0.5 * inv_kappa * p * p;
      const S theta = determinant(F) - 1.0 + inv_kappa * p_mean;
      density += 0.5 * tau_v * theta * theta;
      for (int i = 0; i < 3; ++i) density += (0.5 * alpha * d_q[i] - r_q[i]) * d_q[i];
      total += q.weight * T.volume * density;
    }
    return total;
  }

  /// The PSPG rows −τ ∫ (α d − r − r' + J F⁻ᵀ∇p)·F⁻ᵀ∇N_a dV.
  template <class S>
  std::array<S, 4> pspg(const std::array<S, 16>& x) const {
    const std::array<Vec<S>, 4> d = displacement(x);
    std::array<S, 4> rows;
    for (S& row : rows) row = 0.0;
    for (const TetPoint& q : tet_rule()) {
      const Mat<S> F = deformation(d);
      const Mat<S> F_inv_t = inverse_transpose(F);
      const S J = determinant(F);
      const Vec<S> d_q = at(q.N, d);
      const Vec<double> r_q = at(q.N, r);
      for (int i = 0; i < 3; ++i) {
        S strong = alpha * d_q[i] - r_q[i] - subscale_r[i];
        for (int a = 0; a < 4; ++a) strong += J * x[12 + a] * spatial(F_inv_t, i, a);
        for (int a = 0; a < 4; ++a)
          rows[a] -= tau * q.weight * T.volume * strong * spatial(F_inv_t, i, a);
      }
    }
    return rows;
  }

private:
  template <class S>
  static std::array<Vec<S>, 4> displacement(const std::array<S, 16>& x) {
    std::array<Vec<S>, 4> d;
    for (int a = 0; a < 4; ++a)
      for (int i = 0; i < 3; ++i) d[a][i] = x[3 * a + i];
    return d;
  }
  template <class S>
  Mat<S> deformation(const std::array<Vec<S>, 4>& d) const {
    Mat<S> F = gradient(d, T.grad_N);
    for (int i = 0; i < 3; ++i) F[i][i] += 1.0;
    return F;
  }
  template <class S>
  S spatial(const Mat<S>& F_inv_t, int i, int a) const {
    return F_inv_t[i][0] * T.grad_N[a][0] + F_inv_t[i][1] * T.grad_N[a][1] +
           F_inv_t[i][2] * T.grad_N[a][2];
  }
};

}  // namespace tunica::oracle
