#pragma once
#include "tunica/materials/hyperelastic_law.hpp"
#include "tunica/materials/registry.hpp"

namespace tunica::materials {

/// St. Venant–Kirchhoff: linear between Green's strain and the second Piola–Kirchhoff stress, and
/// Hooke's law where strains are small. Equations in st_venant_kirchhoff.cpp.
class StVenantKirchhoff final : public HyperelasticLaw {
public:
  /// E: Young's modulus [kPa]; nu: Poisson's ratio, below 1/2.
  StVenantKirchhoff(double E, double nu);

  double energy(const Sym3& C, const Frame&) const override;
  Sym3 stress(const Sym3& C, const Frame&) const override;
  StressTangent response(const Sym3& C, const Frame&) const override;
  double stabilisation_modulus() const override { return 2.0 * mu_; }

private:
  double lambda_, mu_, kappa_;
};

/// Registration: "st-venant-kirchhoff" with Young's modulus and Poisson's ratio, which fix the
/// bulk modulus too.
LawEntry st_venant_kirchhoff();

}  // namespace tunica::materials
