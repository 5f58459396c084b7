#pragma once
#include <Sacado.hpp>
#include <array>

namespace tunica::oracle {

// Algebra for any scalar type: numbers, first and second derivatives.

template <int n>
using First = Sacado::Fad::SFad<double, n>;
template <int n>
using Second = Sacado::Fad::SFad<First<n>, n>;

template <class S>
using Vec = std::array<S, 3>;
template <class S>
using Mat = std::array<std::array<S, 3>, 3>;

/// The k-th of n independent variables.
template <int n>
void seed(First<n>& x, int k, double value) {
  x = First<n>(n, k, value);
}
template <int n>
void seed(Second<n>& x, int k, double value) {
  x = Second<n>(n, k, First<n>(n, k, value));
}
inline void seed(double& x, int, double value) { x = value; }

template <class S>
S determinant(const Mat<S>& A) {
  const S m0 = A[1][1] * A[2][2] - A[1][2] * A[2][1];
  const S m1 = A[1][0] * A[2][2] - A[1][2] * A[2][0];
  const S m2 = A[1][0] * A[2][1] - A[1][1] * A[2][0];
  return A[0][0] * m0 - A[0][1] * m1 + A[0][2] * m2;
}

/// A⁻ᵀ by cofactors.
template <class S>
Mat<S> inverse_transpose(const Mat<S>& A) {
  const S one_over_det = 1.0 / determinant(A);
  Mat<S> B;
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j) {
      const int i1 = (i + 1) % 3, i2 = (i + 2) % 3, j1 = (j + 1) % 3, j2 = (j + 2) % 3;
      B[i][j] = one_over_det * (A[i1][j1] * A[i2][j2] - A[i1][j2] * A[i2][j1]);
    }
  return B;
}

/// C = FᵀF.
template <class S>
Mat<S> gram(const Mat<S>& F) {
  Mat<S> C;
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j) C[i][j] = F[0][i] * F[0][j] + F[1][i] * F[1][j] + F[2][i] * F[2][j];
  return C;
}

/// Interpolation of nodal vectors at barycentric coordinates N.
template <class S, std::size_t n>
Vec<S> at(const std::array<double, n>& N, const std::array<Vec<S>, n>& nodal) {
  Vec<S> v{S(0.0), S(0.0), S(0.0)};
  for (std::size_t a = 0; a < n; ++a)
    for (int i = 0; i < 3; ++i) v[i] += N[a] * nodal[a][i];
  return v;
}

/// Σ_a v_a ⊗ ∇N_a.
template <class S, class T>
Mat<S> gradient(const std::array<Vec<S>, 4>& nodal, const std::array<Vec<T>, 4>& grad_N) {
  Mat<S> G;
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j) {
      G[i][j] = 0.0;
      for (int a = 0; a < 4; ++a) G[i][j] += nodal[a][i] * grad_N[a][j];
    }
  return G;
}

/// Geometry of a tetrahedron by inverting its affine map; G: of the vertices' positions.
template <class G>
struct ElementOf {
  G volume;
  std::array<Vec<G>, 4> grad_N;

  explicit ElementOf(const std::array<Vec<G>, 4>& x) {
    Mat<G> map;  // columns x_k − x_0
    for (int i = 0; i < 3; ++i)
      for (int k = 0; k < 3; ++k) map[i][k] = x[k + 1][i] - x[0][i];
    volume = determinant(map) / 6;
    const Mat<G> inverse_t = inverse_transpose(map);
    for (int i = 0; i < 3; ++i) {
      grad_N[0][i] = 0;
      for (int k = 0; k < 3; ++k) {
        grad_N[k + 1][i] = inverse_t[i][k];
        grad_N[0][i] -= inverse_t[i][k];
      }
    }
  }
};
using Element = ElementOf<double>;

}  // namespace tunica::oracle
