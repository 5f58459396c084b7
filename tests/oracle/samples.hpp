#pragma once
#include <algorithm>
#include <cmath>
#include <random>

#include "tunica/base/tensor.hpp"

namespace tunica::oracle {

/// Reproducible random data of the size met in an artery: lengths of some 0.1 mm.
class Samples {
public:
  explicit Samples(unsigned seed) : engine_(seed) {}

  double number(double low, double high) {
    return std::uniform_real_distribution<double>(low, high)(engine_);
  }
  Vec3 vector(double size) {
    return {number(-size, size), number(-size, size), number(-size, size)};
  }
  std::array<Vec3, 4> vectors(double size) {
    return {vector(size), vector(size), vector(size), vector(size)};
  }
  std::array<double, 4> numbers(double size) {
    const Vec3 v = vector(size);
    return {v[0], v[1], v[2], number(-size, size)};
  }

  /// A tetrahedron of positive volume, edges about 0.3 mm, none too flat.
  std::array<Vec3, 4> tetrahedron() {
    for (;;) {
      std::array<Vec3, 4> x = vectors(0.2);
      const double V = signed_volume(x[0], x[1], x[2], x[3]);
      if (std::abs(V) < 1e-3) continue;
      if (V < 0) std::swap(x[0], x[1]);
      return x;
    }
  }

  /// Vertex displacements whose deformation gradient is I + O(size), plus a translation.
  std::array<Vec3, 4> deformation(const std::array<Vec3, 4>& x, double size) {
    const Mat3 H = {{vector(size), vector(size), vector(size)}};
    const Vec3 shift = vector(0.1);
    return {H * x[0] + shift, H * x[1] + shift, H * x[2] + shift, H * x[3] + shift};
  }

  Mat3 rotation() {
    Vec3 a = vector(1.0);
    a = (1.0 / norm(a)) * a;
    const double angle = number(0.5, 3.0);
    const double c = std::cos(angle), s = std::sin(angle);
    Mat3 Q;
    for (int i = 0; i < 3; ++i) {
      const Vec3 e = identity()[i];
      const Vec3 column = c * e + s * cross(a, e) + ((1 - c) * a[i]) * a;
      for (int k = 0; k < 3; ++k) Q[k][i] = column[k];
    }
    return Q;
  }

private:
  std::mt19937 engine_;
};

/// Largest difference relative to the largest expected entry.
class Deviation {
public:
  void add(double found, double expected) {
    difference_ = std::max(difference_, std::abs(found - expected));
    size_ = std::max(size_, std::abs(expected));
  }
  double relative() const { return difference_ == 0.0 ? 0.0 : difference_ / size_; }

private:
  double difference_ = 0.0;
  double size_ = 0.0;
};

}  // namespace tunica::oracle
