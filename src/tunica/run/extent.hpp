#pragma once
#include <string>

#include "tunica/base/tensor.hpp"
#include "tunica/base/types.hpp"
#include "tunica/mesh/mesh.hpp"

namespace tunica::run {

/// Multiplies the vertices: what a case's "Mesh / scale" asks for.
void scale(mesh::Mesh& mesh, double factor);

/// "3.0 x 3.0 x 15.0 mm": three digits of the longest.
std::string extent_text(const Vec3& extent);

/// A question about the unit if the longest extent is below 0.5 mm or above 5000 mm, as no vessel
/// in mm is; otherwise empty.
std::string doubt_of_unit(const Vec3& extent);

/// Prints the extent, and on the error stream the doubt, on rank 0.
void print_extent(const Vec3& extent, const std::string& program, const Comm& comm);

}  // namespace tunica::run
