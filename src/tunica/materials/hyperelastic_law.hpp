#pragma once
#include "tunica/materials/wall_law.hpp"

namespace tunica::materials {

/// A law whose stress follows from an energy Ψ'(C): it remembers nothing. A law with another
/// volumetric part than κ/2 (J − 1)² has the difference in Ψ'.
class HyperelasticLaw : public WallLaw {
public:
  /// Energy Ψ'(C) per reference volume [kPa]; zero at C = I.
  virtual double energy(const Sym3& C, const Frame& frame) const = 0;

  /// S'(C) = 2 ∂Ψ'/∂C [kPa].
  virtual Sym3 stress(const Sym3& C, const Frame& frame) const = 0;

  /// S'(C) and its tangent.
  virtual StressTangent response(const Sym3& C, const Frame& frame) const = 0;

  /// Stress and response at the points of a pack. The default is point by point; a law may override
  /// them for speed.
  virtual Sym3Of<Pack> packed_stress(const Sym3Of<Pack>& C, const FrameOf<Pack>& frame) const;
  virtual StressTangentOf<Pack> packed_response(const Sym3Of<Pack>& C,
                                                const FrameOf<Pack>& frame) const;

  // WallLaw
  double energy(const Sym3& C, const Frame& frame, const Past&) const final {
    return energy(C, frame);
  }
  Sym3 stress(const Sym3& C, const Frame& frame, const Past&) const final {
    return stress(C, frame);
  }
  StressTangent response(const Sym3& C, const Frame& frame, const Past&) const final {
    return response(C, frame);
  }
  Sym3Of<Pack> packed_stress(const Sym3Of<Pack>& C, const FrameOf<Pack>& frame,
                             const PackedPast&) const final {
    return packed_stress(C, frame);
  }
  StressTangentOf<Pack> packed_response(const Sym3Of<Pack>& C, const FrameOf<Pack>& frame,
                                        const PackedPast&) const final {
    return packed_response(C, frame);
  }
};

}  // namespace tunica::materials
