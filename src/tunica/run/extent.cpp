#include "tunica/run/extent.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "tunica/io/messages.hpp"

namespace tunica::run {
namespace {

double longest(const Vec3& extent) { return *std::max_element(extent.begin(), extent.end()); }

std::string number(double value, int decimals) {
  char text[64];
  std::snprintf(text, sizeof text, "%.*f", decimals, value);
  return text;
}

/// So many that the longest has three digits.
int decimals_of(const Vec3& extent) {
  if (!(longest(extent) > 0.0)) return 0;
  return std::clamp(2 - static_cast<int>(std::floor(std::log10(longest(extent)))), 0, 12);
}

}  // namespace

void scale(mesh::Mesh& mesh, double factor) {
  if (factor == 1.0) return;
  for (Vec3& x : mesh.vertices) x = factor * x;
}

std::string extent_text(const Vec3& extent) {
  const int decimals = decimals_of(extent);
  return number(extent[0], decimals) + " x " + number(extent[1], decimals) + " x " +
         number(extent[2], decimals) + " mm";
}

std::string doubt_of_unit(const Vec3& extent) {
  const double length = longest(extent);
  if (length >= 0.5 && length <= 5000.0) return "";
  const std::string so_long =
      "the longest extent of the mesh is " + number(length, decimals_of(extent)) + " mm: ";
  return so_long + "is it in " + (length < 0.5 ? "m" : "µm") + "? See \"Mesh / scale\".";
}

void print_extent(const Vec3& extent, const std::string& program, const Comm& comm) {
  if (comm.getRank() != 0) return;
  io::print_line("mesh: " + extent_text(extent));
  const std::string doubt = doubt_of_unit(extent);
  if (!doubt.empty()) io::print_error_line(program + ": " + doubt);
}

}  // namespace tunica::run
