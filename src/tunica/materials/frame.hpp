#pragma once
#include "tunica/base/pack.hpp"
#include "tunica/base/tensor.hpp"

namespace tunica::materials {

/// Orthonormal directions of the wall at a point of the reference configuration, right-handed
/// in this order. Fibres are described in it; isotropic laws ignore it.
template <class Real>
struct FrameOf {
  Vec3Of<Real> radial{1, 0, 0};  ///< from the lumen outward
  Vec3Of<Real> circumferential{0, 1, 0};
  Vec3Of<Real> axial{0, 0, 1};
};
using Frame = FrameOf<double>;
inline void set_lane(FrameOf<Pack>& to, int lane, const Frame& from) {
  set_lane(to.radial, lane, from.radial);
  set_lane(to.circumferential, lane, from.circumferential);
  set_lane(to.axial, lane, from.axial);
}

/// The directions of a frame before the deformation F: those of the same material lines,
/// orthonormalised.
inline Frame pulled_back(const Frame& frame, const Mat3& F) {
  const Mat3 F_inverse = adjugate(F);  // but for a factor, which does not matter
  const Vec3 c = unit(F_inverse * frame.circumferential);
  Vec3 along = F_inverse * frame.axial;
  along += -dot(along, c) * c;
  const Vec3 a = unit(along);
  return {cross(c, a), c, a};
}

}  // namespace tunica::materials
