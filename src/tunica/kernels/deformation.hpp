#pragma once
#include "tunica/kernels/tet4.hpp"

namespace tunica::kernels {

/// F = I + Σ_a d_a ⊗ ∇N_a, constant on the element.
inline Mat3 deformation_gradient(const Tet4& T, const std::array<Vec3, 4>& d) {
  Mat3 F = identity();
  for (int a = 0; a < 4; ++a)
    for (int i = 0; i < 3; ++i)
      for (int j = 0; j < 3; ++j) F[i][j] += d[a][i] * T.grad_N[a][j];
  return F;
}

/// C = FᵀF.
inline Sym3 right_cauchy_green(const Mat3& F) {
  const auto entry = [&F](int i, int j) {
    return F[0][i] * F[0][j] + F[1][i] * F[1][j] + F[2][i] * F[2][j];
  };
  return {entry(0, 0), entry(1, 1), entry(2, 2), entry(0, 1), entry(1, 2), entry(2, 0)};
}

/// S x for symmetric S.
inline Vec3 apply(const Sym3& S, const Vec3& x) {
  return {S[0] * x[0] + S[3] * x[1] + S[5] * x[2], S[3] * x[0] + S[1] * x[1] + S[4] * x[2],
          S[5] * x[0] + S[4] * x[1] + S[2] * x[2]};
}

}  // namespace tunica::kernels
