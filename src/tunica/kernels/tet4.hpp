#pragma once
#include <array>

#include "tunica/base/tensor.hpp"

namespace tunica::kernels {

/// Geometry of a linear tetrahedron: what the kernels need of it.
struct Tet4 {
  double volume;               ///< positive unless the element is inverted
  std::array<Vec3, 4> grad_N;  ///< constant gradients of the four hat functions
};

/// Geometry from the four vertices; the caller checks the sign of the volume.
Tet4 make_tet4(const std::array<Vec3, 4>& x);

/// Element length h = (6√2 V)^(1/3), the edge of the regular tetrahedron of equal volume.
double element_length(double volume);

/// Σ_a u_a ⊗ ∇N_a, constant on the element.
inline Mat3 gradient(const Tet4& T, const std::array<Vec3, 4>& u) {
  Mat3 G{};
  for (int a = 0; a < 4; ++a)
    for (int i = 0; i < 3; ++i)
      for (int j = 0; j < 3; ++j) G[i][j] += u[a][i] * T.grad_N[a][j];
  return G;
}

/// Residual of a field with one vector and one scalar unknown per vertex.
struct MixedResidual {
  std::array<Vec3, 4> u;    ///< momentum rows
  std::array<double, 4> p;  ///< continuity rows
};

/// Jacobian of a MixedResidual by pairs of vertices, the blocks of [A B1ᵀ; B2 −C].
struct MixedJacobian {
  double A[4][4][3][3];  ///< A[a][b][i][j] = ∂R_u[a][i]/∂u[b][j]
  double B1T[4][4][3];   ///< ∂R_u[a][i]/∂p[b]
  double B2[4][4][3];    ///< ∂R_p[a]/∂u[b][j]
  double mC[4][4];       ///< ∂R_p[a]/∂p[b], that is −C
};

}  // namespace tunica::kernels
