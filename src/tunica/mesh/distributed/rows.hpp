#pragma once
#include <array>
#include <cstddef>
#include <vector>

#include "tunica/base/rows.hpp"

namespace tunica::mesh {

/// Every vertex of some elements once, ascending.
template <std::size_t N>
std::vector<int> vertices_of(const std::vector<std::array<int, N>>& elements);

}  // namespace tunica::mesh
