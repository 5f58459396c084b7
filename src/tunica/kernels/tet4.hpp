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

/// Geometry from the four vertices; the caller checks the sign of the volume.
///
/// ∇N_a = n_a / (−3 V), n_a the outward area normal of the face opposite to a. The first is minus
/// the sum of the others, so that constants have no gradient.
template <class Real>
inline Tet4Of<Real> make_tet4(const std::array<Vec3Of<Real>, 4>& x) {
  const Vec3Of<Real> e1 = x[1] - x[0];
  const Vec3Of<Real> e2 = x[2] - x[0];
  const Vec3Of<Real> e3 = x[3] - x[0];
  const Vec3Of<Real> n1 = cross(e2, e3);
  const Real six_V = dot(e1, n1);
  const Real scale = 1.0 / six_V;
  Tet4Of<Real> T;
  T.volume = six_V / 6.0;
  T.grad_N[1] = scale * n1;
  T.grad_N[2] = scale * cross(e3, e1);
  T.grad_N[3] = scale * cross(e1, e2);
  T.grad_N[0] = -1.0 * (T.grad_N[1] + T.grad_N[2] + T.grad_N[3]);
  return T;
}

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
