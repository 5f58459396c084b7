#include "tunica/materials/wall_law.hpp"

namespace tunica::materials {

namespace {

Frame lane_of(const FrameOf<Pack>& frame, int lane) {
  return {tunica::lane_of(frame.radial, lane), tunica::lane_of(frame.circumferential, lane),
          tunica::lane_of(frame.axial, lane)};
}

}  // namespace

Sym3Of<Pack> WallLaw::packed_stress(const Sym3Of<Pack>& C, const FrameOf<Pack>& frame,
                                    const PackedPast& past) const {
  Sym3Of<Pack> result;
  for (int lane = 0; lane < Pack::size; ++lane)
    set_lane(result, lane, stress(tunica::lane_of(C, lane), lane_of(frame, lane), past[lane]));
  return result;
}

StressTangentOf<Pack> WallLaw::packed_response(const Sym3Of<Pack>& C, const FrameOf<Pack>& frame,
                                               const PackedPast& past) const {
  StressTangentOf<Pack> result;
  for (int lane = 0; lane < Pack::size; ++lane) {
    const StressTangent mine = response(tunica::lane_of(C, lane), lane_of(frame, lane), past[lane]);
    set_lane(result.S, lane, mine.S);
    set_lane(result.D, lane, mine.D);
  }
  return result;
}

}  // namespace tunica::materials
