#pragma once
#include "tunica/base/tensor.hpp"

namespace tunica::materials {

inline constexpr Sym3 unit_tensor{1, 1, 1, 0, 0, 0};

template <class Real>
inline Real trace(const Sym3Of<Real>& A) {
  return A[0] + A[1] + A[2];
}

/// A : B with both off-diagonal halves counted.
template <class Real>
inline Real contract(const Sym3Of<Real>& A, const Sym3Of<Real>& B) {
  return A[0] * B[0] + A[1] * B[1] + A[2] * B[2] + 2.0 * (A[3] * B[3] + A[4] * B[4] + A[5] * B[5]);
}

/// det(A) A⁻¹.
template <class Real>
inline Sym3Of<Real> adjugate(const Sym3Of<Real>& A) {
  return {A[1] * A[2] - A[4] * A[4], A[2] * A[0] - A[5] * A[5], A[0] * A[1] - A[3] * A[3],
          A[4] * A[5] - A[2] * A[3], A[5] * A[3] - A[0] * A[4], A[3] * A[4] - A[1] * A[5]};
}

/// det A, given its adjugate.
template <class Real>
inline Real det(const Sym3Of<Real>& A, const Sym3Of<Real>& adj) {
  return A[0] * adj[0] + A[3] * adj[3] + A[5] * adj[5];
}

template <class Real>
struct Inverse {
  Sym3Of<Real> inverse;
  Real det;
};

template <class Real>
inline Inverse<Real> inverse_of(const Sym3Of<Real>& A) {
  const Sym3Of<Real> adj = adjugate(A);
  Inverse<Real> result;
  result.det = det(A, adj);
  const Real inverse = 1.0 / result.det;
  for (int I = 0; I < 6; ++I) result.inverse[I] = inverse * adj[I];
  return result;
}

/// D += Y ⊗ Z + Z ⊗ Y.
template <class Real>
inline void add_symmetric_product(Sym3MapOf<Real>& D, const Sym3Of<Real>& Y,
                                  const Sym3Of<Real>& Z) {
  for (int I = 0; I < 6; ++I)
    for (int J = 0; J < 6; ++J) D[I][J] += Y[I] * Z[J] + Z[I] * Y[J];
}

/// D += w A ⊙ A, (A ⊙ A)[ij][kl] = (A_ik A_jl + A_il A_jk) / 2, the map dC -> A dC A.
template <class Real>
inline void add_congruence(Sym3MapOf<Real>& D, const Factor<Real>& w, const Sym3Of<Real>& A) {
  const Real M[3][3] = {{A[0], A[3], A[5]}, {A[3], A[1], A[4]}, {A[5], A[4], A[2]}};
  constexpr int row[6] = {0, 1, 2, 0, 1, 2};
  constexpr int col[6] = {0, 1, 2, 1, 2, 0};
  for (int I = 0; I < 6; ++I)
    for (int J = I; J < 6; ++J) {
      const Real value =
          0.5 * w * (M[row[I]][row[J]] * M[col[I]][col[J]] + M[row[I]][col[J]] * M[col[I]][row[J]]);
      D[I][J] += value;
      if (J > I) D[J][I] += value;
    }
}

}  // namespace tunica::materials
