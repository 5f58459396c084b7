#pragma once
#include <array>
#include <cmath>

namespace tunica {

using Vec3 = std::array<double, 3>;
using Mat3 = std::array<Vec3, 3>;  ///< row by row

/// Symmetric tensor in the order xx, yy, zz, xy, yz, zx.
using Sym3 = std::array<double, 6>;
/// Linear map between symmetric tensors in the same order.
using Sym3Map = std::array<std::array<double, 6>, 6>;

inline Vec3 operator+(const Vec3& a, const Vec3& b) {
  return {a[0] + b[0], a[1] + b[1], a[2] + b[2]};
}
inline Vec3 operator-(const Vec3& a, const Vec3& b) {
  return {a[0] - b[0], a[1] - b[1], a[2] - b[2]};
}
inline Vec3 operator*(double s, const Vec3& a) { return {s * a[0], s * a[1], s * a[2]}; }
inline Vec3& operator+=(Vec3& a, const Vec3& b) { return a = a + b; }
inline double dot(const Vec3& a, const Vec3& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }
inline Vec3 cross(const Vec3& a, const Vec3& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}
inline double norm(const Vec3& a) { return std::sqrt(dot(a, a)); }

inline Mat3 identity() { return {{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}}; }
inline Vec3 operator*(const Mat3& A, const Vec3& x) {
  return {dot(A[0], x), dot(A[1], x), dot(A[2], x)};
}
inline double det(const Mat3& A) { return dot(A[0], cross(A[1], A[2])); }
inline Mat3 transpose(const Mat3& A) {
  return {{{A[0][0], A[1][0], A[2][0]}, {A[0][1], A[1][1], A[2][1]}, {A[0][2], A[1][2], A[2][2]}}};
}
/// det(A) A⁻¹, defined for singular A too.
inline Mat3 adjugate(const Mat3& A) {
  return transpose({cross(A[1], A[2]), cross(A[2], A[0]), cross(A[0], A[1])});
}

/// Six times the signed volume of the tetrahedron is det(b − a, c − a, d − a).
inline double signed_volume(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d) {
  return dot(b - a, cross(c - a, d - a)) / 6.0;
}

}  // namespace tunica
