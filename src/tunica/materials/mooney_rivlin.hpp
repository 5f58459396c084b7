#pragma once
#include "tunica/materials/hyperelastic_law.hpp"
#include "tunica/materials/registry.hpp"

namespace tunica::materials {

/// Modified Mooney–Rivlin; neo-Hookean where c01 = 0. Equations in mooney_rivlin.cpp.
class MooneyRivlin final : public HyperelasticLaw {
public:
  MooneyRivlin(double c10, double c01) : c10_(c10), c01_(c01) {}

  double energy(const Sym3& C, const Frame&) const override;
  Sym3 stress(const Sym3& C, const Frame&) const override;
  StressTangent response(const Sym3& C, const Frame&) const override;
  Sym3Of<Pack> packed_stress(const Sym3Of<Pack>& C, const FrameOf<Pack>&) const override;
  StressTangentOf<Pack> packed_response(const Sym3Of<Pack>& C, const FrameOf<Pack>&) const override;
  double stabilisation_modulus() const override { return 2.0 * (c10_ + c01_); }

private:
  double c10_;
  double c01_;
};

/// Registration: "mooney-rivlin" with c10 and c01, "neo-hookean" with c10 alone.
LawEntry mooney_rivlin();
LawEntry neo_hookean();

}  // namespace tunica::materials
