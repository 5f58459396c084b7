#pragma once
#include "tunica/base/tensor.hpp"

namespace tunica::materials {

/// Orthonormal directions of the wall at a point of the reference configuration, right-handed
/// in this order. Fibres are described in it; isotropic laws ignore it.
struct Frame {
  Vec3 radial{1, 0, 0};  ///< from the lumen outward
  Vec3 circumferential{0, 1, 0};
  Vec3 axial{0, 0, 1};
};

}  // namespace tunica::materials
