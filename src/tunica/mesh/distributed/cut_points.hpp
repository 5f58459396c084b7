#pragma once
#include <vector>

#include "tunica/base/tensor.hpp"
#include "tunica/base/types.hpp"

namespace tunica::mesh {

/// Cuts points by planes into as many parts as there are ranks, of the same size as far as
/// possible. Returns the part of each point of the calling rank, which may have none. Collective.
std::vector<int> cut_by_planes(const std::vector<Vec3>& points, const CommPtr& comm);

}  // namespace tunica::mesh
