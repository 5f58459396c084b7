#pragma once
#include <algorithm>
#include <array>

#include "tunica/base/tensor.hpp"

namespace tunica::fields {

/// A weight below zero by no more is one of the inside.
constexpr double weight_round_off = 1e-10;

template <std::size_t n>
Vec3 point_of(const std::array<double, n>& weights, const std::array<Vec3, n>& x) {
  Vec3 sum{};
  for (std::size_t a = 0; a < n; ++a) sum += weights[a] * x[a];
  return sum;
}

/// Shares of the volumes that the point cuts the tetrahedron into.
inline std::array<double, 4> weights_in(const std::array<Vec3, 4>& x, const Vec3& point) {
  const double volume = signed_volume(x[0], x[1], x[2], x[3]);
  std::array<double, 4> weights;
  for (int a = 0; a < 4; ++a) {
    std::array<Vec3, 4> part = x;
    part[a] = point;
    weights[a] = signed_volume(part[0], part[1], part[2], part[3]) / volume;
  }
  return weights;
}

inline bool is_inside(const std::array<double, 4>& weights) {
  return *std::min_element(weights.begin(), weights.end()) >= -weight_round_off;
}

/// Weights of the corners at what is nearest to the point on a triangle.
std::array<double, 3> nearest_on(const std::array<Vec3, 3>& x, const Vec3& point);

/// The same on a tetrahedron, inside of it as well.
std::array<double, 4> nearest_in(const std::array<Vec3, 4>& x, const Vec3& point);

}  // namespace tunica::fields
