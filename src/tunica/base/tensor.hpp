#pragma once
#include <array>
#include <cmath>
#include <type_traits>

namespace tunica {

// Tensors of any kind of number: double, or Pack (pack.hpp) for those of several elements at once.

template <class Real>
using Vec3Of = std::array<Real, 3>;
template <class Real>
using Mat3Of = std::array<Vec3Of<Real>, 3>;  ///< row by row
/// Symmetric tensor in the order xx, yy, zz, xy, yz, zx.
template <class Real>
using Sym3Of = std::array<Real, 6>;
/// Linear map between symmetric tensors in the same order.
template <class Real>
using Sym3MapOf = std::array<std::array<Real, 6>, 6>;

using Vec3 = Vec3Of<double>;
using Mat3 = Mat3Of<double>;
using Sym3 = Sym3Of<double>;
using Sym3Map = Sym3MapOf<double>;

/// A factor: converted to the kind of number of what it multiplies.
template <class Real>
using Factor = std::common_type_t<Real>;

template <class Real>
inline Vec3Of<Real> operator+(const Vec3Of<Real>& a, const Vec3Of<Real>& b) {
  return {a[0] + b[0], a[1] + b[1], a[2] + b[2]};
}
template <class Real>
inline Vec3Of<Real> operator-(const Vec3Of<Real>& a, const Vec3Of<Real>& b) {
  return {a[0] - b[0], a[1] - b[1], a[2] - b[2]};
}
template <class Real>
inline Vec3Of<Real> operator*(const Factor<Real>& s, const Vec3Of<Real>& a) {
  return {s * a[0], s * a[1], s * a[2]};
}
template <class Real>
inline Vec3Of<Real>& operator+=(Vec3Of<Real>& a, const Vec3Of<Real>& b) {
  return a = a + b;
}
template <class Real>
inline Real dot(const Vec3Of<Real>& a, const Vec3Of<Real>& b) {
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}
template <class Real>
inline Vec3Of<Real> cross(const Vec3Of<Real>& a, const Vec3Of<Real>& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}
inline double norm(const Vec3& a) { return std::sqrt(dot(a, a)); }
/// a / |a|.
inline Vec3 unit(const Vec3& a) { return 1.0 / norm(a) * a; }

template <class Real = double>
inline Mat3Of<Real> identity() {
  return {{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}};
}
template <class Real>
inline Vec3Of<Real> operator*(const Mat3Of<Real>& A, const Vec3Of<Real>& x) {
  return {dot(A[0], x), dot(A[1], x), dot(A[2], x)};
}
template <class Real>
inline Real det(const Mat3Of<Real>& A) {
  return dot(A[0], cross(A[1], A[2]));
}
template <class Real>
inline Mat3Of<Real> transpose(const Mat3Of<Real>& A) {
  return {{{A[0][0], A[1][0], A[2][0]}, {A[0][1], A[1][1], A[2][1]}, {A[0][2], A[1][2], A[2][2]}}};
}
inline Mat3 operator*(const Mat3& A, const Mat3& B) {
  const Mat3 Bt = transpose(B);
  return {{Bt * A[0], Bt * A[1], Bt * A[2]}};
}
/// ½ (A + Aᵀ).
inline Mat3 symmetric_part(const Mat3& A) {
  const Mat3 At = transpose(A);
  return {{0.5 * (A[0] + At[0]), 0.5 * (A[1] + At[1]), 0.5 * (A[2] + At[2])}};
}
/// det(A) A⁻¹, defined for singular A too.
template <class Real>
inline Mat3Of<Real> adjugate(const Mat3Of<Real>& A) {
  return transpose<Real>({cross(A[1], A[2]), cross(A[2], A[0]), cross(A[0], A[1])});
}

/// Six times the signed volume of the tetrahedron is det(b − a, c − a, d − a).
inline double signed_volume(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d) {
  return dot(b - a, cross(c - a, d - a)) / 6.0;
}

}  // namespace tunica
