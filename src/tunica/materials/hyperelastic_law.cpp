#include "tunica/materials/hyperelastic_law.hpp"

namespace tunica::materials {

namespace {

Frame lane_of(const FrameOf<Pack>& frame, int lane) {
  return {tunica::lane_of(frame.radial, lane), tunica::lane_of(frame.circumferential, lane),
          tunica::lane_of(frame.axial, lane)};
}

}  // namespace

Sym3Of<Pack> HyperelasticLaw::packed_stress(const Sym3Of<Pack>& C,
                                            const FrameOf<Pack>& frame) const {
  Sym3Of<Pack> result;
  for (int lane = 0; lane < Pack::size; ++lane)
    set_lane(result, lane, stress(tunica::lane_of(C, lane), lane_of(frame, lane)));
  return result;
}

StressTangentOf<Pack> HyperelasticLaw::packed_response(const Sym3Of<Pack>& C,
                                                       const FrameOf<Pack>& frame) const {
  StressTangentOf<Pack> result;
  for (int lane = 0; lane < Pack::size; ++lane) {
    const StressTangent mine = response(tunica::lane_of(C, lane), lane_of(frame, lane));
    set_lane(result.S, lane, mine.S);
    set_lane(result.D, lane, mine.D);
  }
  return result;
}

}  // namespace tunica::materials
