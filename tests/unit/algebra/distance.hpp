#pragma once
#include "tunica/base/types.hpp"

namespace tunica::test {

inline Vector difference(const Vector& a, const Vector& b) {
  Vector d(a, Teuchos::Copy);
  d.update(-1.0, b, 1.0);
  return d;
}

/// |a − b| / |b|
inline double distance(const Vector& a, const Vector& b) {
  return difference(a, b).norm2() / b.norm2();
}

/// The same of the largest entries.
inline double largest_distance(const Vector& a, const Vector& b) {
  return difference(a, b).normInf() / b.normInf();
}

}  // namespace tunica::test
