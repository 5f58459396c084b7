#pragma once
#include "oracle/algebra.hpp"
#include "oracle/quadrature.hpp"

namespace tunica::oracle {

template <class S>
using Triangle = std::array<Vec<S>, 3>;

/// ∂x/∂ξ × ∂x/∂η of the affine map from the unit triangle: twice the area normal.
template <class S>
Vec<S> surface_element(const Triangle<S>& x) {
  Vec<S> n;
  for (int i = 0; i < 3; ++i) {
    const int j = (i + 1) % 3, k = (i + 2) % 3;
    n[i] = (x[1][j] - x[0][j]) * (x[2][k] - x[0][k]) - (x[1][k] - x[0][k]) * (x[2][j] - x[0][j]);
  }
  return n;
}

/// ∫ N_a p n da.
template <class S>
Triangle<S> pressure_load(const Triangle<S>& x, double p) {
  const Vec<S> n = surface_element(x);
  Triangle<S> R;
  for (int a = 0; a < 3; ++a)
    for (int i = 0; i < 3; ++i) {
      R[a][i] = 0.0;
      for (const TriPoint& q : tri_rule()) R[a][i] += 0.5 * q.weight * q.N[a] * p * n[i];
    }
  return R;
}

/// −∫ N_a t da.
template <class S>
Triangle<S> traction_load(const Triangle<S>& x, const Vec<double>& t) {
  using std::sqrt;
  const Vec<S> n = surface_element(x);
  const S area = 0.5 * sqrt(n[0] * n[0] + n[1] * n[1] + n[2] * n[2]);
  Triangle<S> R;
  for (int a = 0; a < 3; ++a)
    for (int i = 0; i < 3; ++i) R[a][i] = -area / 3.0 * t[i];
  return R;
}

/// −βρ ∫ (c·n)₋ u N_a da by the given rule.
template <class S, class X, class U>
Triangle<S> backflow_load(const Triangle<X>& x, const Triangle<U>& u, const Triangle<X>& w,
                          double beta_rho, const std::vector<TriPoint>& rule) {
  const Vec<X> n = surface_element(x);
  Triangle<S> R;
  for (auto& row : R)
    for (S& value : row) value = 0.0;
  for (const TriPoint& q : rule) {
    const Vec<U> u_q = at(q.N, u);
    const Vec<X> w_q = at(q.N, w);
    S flux = 0.0;
    for (int i = 0; i < 3; ++i) flux += (u_q[i] - w_q[i]) * n[i];
    if (flux >= 0.0) flux = 0.0;
    for (int a = 0; a < 3; ++a)
      for (int i = 0; i < 3; ++i) R[a][i] -= 0.5 * q.weight * beta_rho * flux * u_q[i] * q.N[a];
  }
  return R;
}

}  // namespace tunica::oracle
