#include "tunica/materials/hyperelastic_law.hpp"

namespace tunica::materials {

Sym3Of<Pack> HyperelasticLaw::packed_stress(const Sym3Of<Pack>& C,
                                            const FrameOf<Pack>& frame) const {
  return WallLaw::packed_stress(C, frame, {});
}

StressTangentOf<Pack> HyperelasticLaw::packed_response(const Sym3Of<Pack>& C,
                                                       const FrameOf<Pack>& frame) const {
  return WallLaw::packed_response(C, frame, {});
}

}  // namespace tunica::materials
