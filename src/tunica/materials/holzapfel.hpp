#pragma once
#include "tunica/materials/mooney_rivlin.hpp"

namespace tunica::materials {

/// The collagen of one layer: two families of fibres between circumference and axis.
struct Fibres {
  double k1;          ///< stiffness [kPa]
  double k2;          ///< how fast they stiffen, positive
  double angle;       ///< ± from the circumferential direction [degrees]
  double dispersion;  ///< 0: all parallel; 1/3: isotropic
};

/// The constants as used in the equations.
struct HolzapfelConstants {
  double k1, k2;
  double cos_angle, sin_angle;
  double dispersion;

  /// Direction of the fibres of the first or the second family.
  template <class Real>
  Vec3Of<Real> direction(const FrameOf<Real>& frame, int family) const {
    return cos_angle * frame.circumferential + (family == 0 ? sin_angle : -sin_angle) * frame.axial;
  }
};

/// Mooney–Rivlin matrix with two families of fibres that stiffen exponentially and carry
/// tension only. Equations in holzapfel.cpp.
class Holzapfel final : public HyperelasticLaw {
public:
  Holzapfel(const MooneyRivlin& matrix, const Fibres& fibres);

  double energy(const Sym3& C, const Frame& frame) const override;
  Sym3 stress(const Sym3& C, const Frame& frame) const override;
  StressTangent response(const Sym3& C, const Frame& frame) const override;
  Sym3Of<Pack> packed_stress(const Sym3Of<Pack>& C, const FrameOf<Pack>& frame) const override;
  StressTangentOf<Pack> packed_response(const Sym3Of<Pack>& C,
                                        const FrameOf<Pack>& frame) const override;
  double stabilisation_modulus() const override;
  bool has_fibres() const override { return true; }
  std::vector<Vec3> fibre_directions(const Frame& frame) const override;

private:
  MooneyRivlin matrix_;
  HolzapfelConstants fibres_;
};

/// Registration: "holzapfel".
LawEntry holzapfel();

}  // namespace tunica::materials
