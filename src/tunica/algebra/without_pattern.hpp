#pragma once
#include <cmath>

#include "tunica/base/trilinos.hpp"

namespace tunica::algebra {

/// Numbers between −1 and 1 in the first column, by the numbers of the rows: the same on any number
/// of ranks, and in no pattern that a mesh could have.
inline void fill_without_pattern(MultiVector& v) {
  const auto values = v.getLocalViewHost(overwrite_all);
  for (std::size_t i = 0; i < values.extent(0); ++i)
    values(i, 0) = std::sin(
        78.233 * static_cast<double>(v.getMap()->getGlobalElement(static_cast<int>(i))) + 1.0);
}

}  // namespace tunica::algebra
