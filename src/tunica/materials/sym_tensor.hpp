#pragma once
#include "tunica/base/tensor.hpp"

namespace tunica::materials {

inline constexpr Sym3 unit_tensor{1, 1, 1, 0, 0, 0};

inline double trace(const Sym3& A) { return A[0] + A[1] + A[2]; }

/// A : B with both off-diagonal halves counted.
inline double contract(const Sym3& A, const Sym3& B) {
  return A[0] * B[0] + A[1] * B[1] + A[2] * B[2] + 2.0 * (A[3] * B[3] + A[4] * B[4] + A[5] * B[5]);
}

/// det(A) A⁻¹.
inline Sym3 adjugate(const Sym3& A) {
  return {A[1] * A[2] - A[4] * A[4], A[2] * A[0] - A[5] * A[5], A[0] * A[1] - A[3] * A[3],
          A[4] * A[5] - A[2] * A[3], A[5] * A[3] - A[0] * A[4], A[3] * A[4] - A[1] * A[5]};
}

/// det A, given its adjugate.
inline double det(const Sym3& A, const Sym3& adj) {
  return A[0] * adj[0] + A[3] * adj[3] + A[5] * adj[5];
}

struct Inverse {
  Sym3 inverse;
  double det;
};

inline Inverse inverse_of(const Sym3& A) {
  const Sym3 adj = adjugate(A);
  Inverse result;
  result.det = det(A, adj);
  for (int I = 0; I < 6; ++I) result.inverse[I] = adj[I] / result.det;
  return result;
}

/// D += Y ⊗ Z + Z ⊗ Y.
inline void add_symmetric_product(Sym3Map& D, const Sym3& Y, const Sym3& Z) {
  for (int I = 0; I < 6; ++I)
    for (int J = 0; J < 6; ++J) D[I][J] += Y[I] * Z[J] + Z[I] * Y[J];
}

/// D += w A ⊙ A, (A ⊙ A)[ij][kl] = (A_ik A_jl + A_il A_jk) / 2, the map dC -> A dC A.
inline void add_congruence(Sym3Map& D, double w, const Sym3& A) {
  const double M[3][3] = {{A[0], A[3], A[5]}, {A[3], A[1], A[4]}, {A[5], A[4], A[2]}};
  constexpr int row[6] = {0, 1, 2, 0, 1, 2};
  constexpr int col[6] = {0, 1, 2, 1, 2, 0};
  for (int I = 0; I < 6; ++I)
    for (int J = I; J < 6; ++J) {
      const double value =
          0.5 * w * (M[row[I]][row[J]] * M[col[I]][col[J]] + M[row[I]][col[J]] * M[col[I]][row[J]]);
      D[I][J] += value;
      if (J > I) D[J][I] += value;
    }
}

}  // namespace tunica::materials
