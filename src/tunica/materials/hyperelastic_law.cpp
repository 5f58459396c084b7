#include "tunica/materials/hyperelastic_law.hpp"

namespace tunica::materials {

namespace {

Sym3 lane_of(const Sym3Of<Pack>& C, int lane) {
  Sym3 mine;
  for (int I = 0; I < 6; ++I) mine[I] = C[I][lane];
  return mine;
}

Vec3 lane_of(const Vec3Of<Pack>& x, int lane) { return {x[0][lane], x[1][lane], x[2][lane]}; }

Frame lane_of(const FrameOf<Pack>& frame, int lane) {
  return {lane_of(frame.radial, lane), lane_of(frame.circumferential, lane),
          lane_of(frame.axial, lane)};
}

}  // namespace

Sym3Of<Pack> HyperelasticLaw::packed_stress(const Sym3Of<Pack>& C,
                                            const FrameOf<Pack>& frame) const {
  Sym3Of<Pack> result;
  for (int lane = 0; lane < Pack::size; ++lane) {
    const Sym3 S = stress(lane_of(C, lane), lane_of(frame, lane));
    for (int I = 0; I < 6; ++I) result[I].set(lane, S[I]);
  }
  return result;
}

StressTangentOf<Pack> HyperelasticLaw::packed_response(const Sym3Of<Pack>& C,
                                                       const FrameOf<Pack>& frame) const {
  StressTangentOf<Pack> result;
  for (int lane = 0; lane < Pack::size; ++lane) {
    const StressTangent mine = response(lane_of(C, lane), lane_of(frame, lane));
    for (int I = 0; I < 6; ++I) {
      result.S[I].set(lane, mine.S[I]);
      for (int J = 0; J < 6; ++J) result.D[I][J].set(lane, mine.D[I][J]);
    }
  }
  return result;
}

}  // namespace tunica::materials
