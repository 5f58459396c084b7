#include "tunica/mesh/text.hpp"

#include <cstdio>

namespace tunica::mesh {

std::string show(double value) {
  char text[32];
  std::snprintf(text, sizeof text, "%.6g", value);
  return text;
}

std::string show(const Vec3& point) {
  return "(" + show(point[0]) + ", " + show(point[1]) + ", " + show(point[2]) + ")";
}

}  // namespace tunica::mesh
