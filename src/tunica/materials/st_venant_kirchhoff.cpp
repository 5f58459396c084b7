#include "tunica/materials/st_venant_kirchhoff.hpp"

#include <cmath>

#include "tunica/materials/sym_tensor.hpp"

namespace tunica::materials {

// St. Venant–Kirchhoff law without the volumetric energy that the pressure field carries.
//
//   Ψ' = λ/2 (tr E)² + μ E:E − κ/2 (J − 1)²,   E = (C − I)/2,  J = √det C,  κ = λ + 2/3 μ
//   S' = λ tr E I + 2μ E − κ (J − 1) J C⁻¹
//   D  = λ I⊗I + 2μ 𝕀 − κ (2J − 1) J C⁻¹⊗C⁻¹ + 2κ (J − 1) J C⁻¹⊙C⁻¹
//
//   λ, μ  Lamé's constants, κ the bulk modulus    kPa
//   E     Green's strain                          1
//
// With p = −κ (J − 1) from the mixed formulation the whole is the plain law. Ψ' is isochoric to
// second order in E only: for ν near 1/2 and large strains other laws are better.
//
// Source: [Hol] section 6.5.
// Deviation: none.

namespace {

double shear_modulus(double E, double nu) { return 0.5 * E / (1.0 + nu); }
double bulk_modulus(double E, double nu) { return E / (3.0 * (1.0 - 2.0 * nu)); }

}  // namespace

StVenantKirchhoff::StVenantKirchhoff(double E, double nu)
    : lambda_(bulk_modulus(E, nu) - 2.0 / 3.0 * shear_modulus(E, nu)), mu_(shear_modulus(E, nu)),
      kappa_(bulk_modulus(E, nu)) {}

double StVenantKirchhoff::energy(const Sym3& C, const Frame&) const {
  Sym3 E;
  for (int I = 0; I < 6; ++I) E[I] = 0.5 * (C[I] - unit_tensor[I]);
  const double J = std::sqrt(det(C, adjugate(C)));
  return 0.5 * lambda_ * trace(E) * trace(E) + mu_ * contract(E, E) -
         0.5 * kappa_ * (J - 1.0) * (J - 1.0);
}

Sym3 StVenantKirchhoff::stress(const Sym3& C, const Frame&) const {
  const auto [C_inv, I3] = inverse_of(C);
  const double J = std::sqrt(I3);
  const double on_unit = 0.5 * lambda_ * (trace(C) - 3.0);
  const double on_inverse = -kappa_ * (J - 1.0) * J;
  Sym3 S;
  for (int I = 0; I < 6; ++I)
    S[I] = on_unit * unit_tensor[I] + mu_ * (C[I] - unit_tensor[I]) + on_inverse * C_inv[I];
  return S;
}

StressTangent StVenantKirchhoff::response(const Sym3& C, const Frame& frame) const {
  const auto [C_inv, I3] = inverse_of(C);
  const double J = std::sqrt(I3);
  StressTangent result;
  result.S = stress(C, frame);
  result.D = {};
  for (int I = 0; I < 3; ++I) {
    for (int K = 0; K < 3; ++K) result.D[I][K] = lambda_;
    result.D[I][I] += 2.0 * mu_;
    result.D[I + 3][I + 3] = mu_;
  }
  Sym3 half;
  for (int I = 0; I < 6; ++I) half[I] = -0.5 * kappa_ * (2.0 * J - 1.0) * J * C_inv[I];
  add_symmetric_product(result.D, half, C_inv);
  add_congruence(result.D, 2.0 * kappa_ * (J - 1.0) * J, C_inv);
  return result;
}

LawEntry st_venant_kirchhoff() {
  LawEntry law{"st-venant-kirchhoff",
               "St. Venant-Kirchhoff law; Hooke's where strains are small.",
               {{"young modulus", 100.0, 0.0, "kPa", "Young's modulus."},
                {"poisson ratio", 0.4, 0.0, "1", "Poisson's ratio; it determines the bulk modulus.",
                 0.4999}},
               [](const Constants& value) {
                 return std::make_unique<StVenantKirchhoff>(value.at("young modulus"),
                                                            value.at("poisson ratio"));
               }};
  law.bulk_modulus = [](const Constants& value) {
    return bulk_modulus(value.at("young modulus"), value.at("poisson ratio"));
  };
  return law;
}

}  // namespace tunica::materials
