#pragma once
#include <cstdio>
#include <sstream>
#include <string>

#include "tunica/base/tensor.hpp"

namespace tunica::mesh {

/// Short decimal form for messages: six digits.
inline std::string show(double value) {
  std::ostringstream stream;
  stream << value;
  return stream.str();
}

/// For files: all digits, so that the number is read back as it was.
inline std::string exact(double value) {
  char text[32];
  std::snprintf(text, sizeof text, "%.17g", value);
  return text;
}

/// "(1.43, 0, 3.2)".
inline std::string show(const Vec3& point) {
  return "(" + show(point[0]) + ", " + show(point[1]) + ", " + show(point[2]) + ")";
}

}  // namespace tunica::mesh
