#pragma once
#include "tunica/kernels/tet4.hpp"

namespace tunica::kernels {

/// F = I + Σ_a d_a ⊗ ∇N_a, constant on the element.
template <class Real>
inline Mat3Of<Real> deformation_gradient(const Tet4Of<Real>& T,
                                         const std::array<Vec3Of<Real>, 4>& d) {
  Mat3Of<Real> F = identity<Real>();
  for (int a = 0; a < 4; ++a)
    for (int i = 0; i < 3; ++i)
      for (int j = 0; j < 3; ++j) F[i][j] += d[a][i] * T.grad_N[a][j];
  return F;
}

/// C = FᵀF.
template <class Real>
inline Sym3Of<Real> right_cauchy_green(const Mat3Of<Real>& F) {
  const auto entry = [&F](int i, int j) {
    return F[0][i] * F[0][j] + F[1][i] * F[1][j] + F[2][i] * F[2][j];
  };
  return {entry(0, 0), entry(1, 1), entry(2, 2), entry(0, 1), entry(1, 2), entry(2, 0)};
}

/// S x for symmetric S.
template <class Real>
inline Vec3Of<Real> apply(const Sym3Of<Real>& S, const Vec3Of<Real>& x) {
  return {S[0] * x[0] + S[3] * x[1] + S[5] * x[2], S[3] * x[0] + S[1] * x[1] + S[4] * x[2],
          S[5] * x[0] + S[4] * x[1] + S[2] * x[2]};
}

}  // namespace tunica::kernels
