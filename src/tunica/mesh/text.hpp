#pragma once
#include <string>

#include "tunica/base/tensor.hpp"

namespace tunica::mesh {

/// Short decimal form for messages: six digits.
std::string show(double value);
/// "(1.43, 0, 3.2)".
std::string show(const Vec3& point);

}  // namespace tunica::mesh
