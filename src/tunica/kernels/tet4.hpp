#pragma once
#include <array>

#include "tunica/base/pack.hpp"
#include "tunica/base/tensor.hpp"

namespace tunica::kernels {

/// Geometry of a linear tetrahedron: what the kernels need of it.
template <class Real>
struct Tet4Of {
  Real volume;                         ///< positive unless the element is inverted
  std::array<Vec3Of<Real>, 4> grad_N;  ///< constant gradients of the four hat functions
};
using Tet4 = Tet4Of<double>;
inline void set_lane(Tet4Of<Pack>& to, int lane, const Tet4& from) {
  set_lane(to.volume, lane, from.volume);
  set_lane(to.grad_N, lane, from.grad_N);
}

/// Geometry from the four vertices; the caller checks the sign of the volume.
Tet4 make_tet4(const std::array<Vec3, 4>& x);

/// Element length h = (6√2 V)^(1/3), the edge of the regular tetrahedron of equal volume.
double element_length(double volume);

/// Σ_a u_a ⊗ ∇N_a, constant on the element.
template <class Real>
inline Mat3Of<Real> gradient(const Tet4Of<Real>& T, const std::array<Vec3Of<Real>, 4>& u) {
  Mat3Of<Real> G{};
  for (int a = 0; a < 4; ++a)
    for (int i = 0; i < 3; ++i)
      for (int j = 0; j < 3; ++j) G[i][j] += u[a][i] * T.grad_N[a][j];
  return G;
}

/// Residual of a field with one vector and one scalar unknown per vertex.
template <class Real>
struct MixedResidualOf {
  std::array<Vec3Of<Real>, 4> u;  ///< momentum rows
  std::array<Real, 4> p;          ///< continuity rows
};
using MixedResidual = MixedResidualOf<double>;

/// Jacobian of a MixedResidual by pairs of vertices, the blocks of [A B1ᵀ; B2 −C].
template <class Real>
struct MixedJacobianOf {
  Real A[4][4][3][3];  ///< A[a][b][i][j] = ∂R_u[a][i]/∂u[b][j]
  Real B1T[4][4][3];   ///< ∂R_u[a][i]/∂p[b]
  Real B2[4][4][3];    ///< ∂R_p[a]/∂u[b][j]
  Real mC[4][4];       ///< ∂R_p[a]/∂p[b], that is −C
};
using MixedJacobian = MixedJacobianOf<double>;

}  // namespace tunica::kernels
