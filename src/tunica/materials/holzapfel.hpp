#pragma once
#include <array>

#include "tunica/materials/mooney_rivlin.hpp"

namespace tunica::materials {

/// The collagen of one layer: two families of fibres between circumference and axis.
struct Fibres {
  double k1;          ///< stiffness [kPa]
  double k2;          ///< how fast they stiffen, positive
  double angle;       ///< ± from the circumferential direction [degrees]
  double dispersion;  ///< 0: all parallel; 1/3: isotropic
};

/// Mooney–Rivlin matrix with two families of fibres that stiffen exponentially and carry
/// tension only. Equations in holzapfel.cpp.
class Holzapfel final : public HyperelasticLaw {
public:
  Holzapfel(const MooneyRivlin& matrix, const Fibres& fibres);

  double energy(const Sym3& C, const Frame& frame) const override;
  Sym3 stress(const Sym3& C, const Frame& frame) const override;
  StressTangent response(const Sym3& C, const Frame& frame) const override;
  double stabilisation_modulus() const override;
  bool has_fibres() const override { return true; }
  std::vector<Vec3> fibre_directions(const Frame& frame) const override;

private:
  Vec3 direction(const Frame& frame, int family) const;
  std::array<Sym3, 2> structure(const Frame& frame) const;

  MooneyRivlin matrix_;
  double k1_, k2_;
  double cos_angle_, sin_angle_;
  double dispersion_;
};

/// Registration: "holzapfel".
LawEntry holzapfel();

}  // namespace tunica::materials
