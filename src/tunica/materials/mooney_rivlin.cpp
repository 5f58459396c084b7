#include "tunica/materials/mooney_rivlin.hpp"

#include "tunica/materials/sym_tensor.hpp"

namespace tunica::materials {

// Modified Mooney–Rivlin law, isochoric part.
//
//   Ψ' = c10/2 (J1 − 3) + c01/2 (J2 − 3),   J1 = I1 a,  J2 = I2 a²,  a = I3^(−1/3)
//   S' = c10 ∂J1/∂C + c01 ∂J2/∂C
//      = c10 a (I − I1/3 C⁻¹) + c01 a² (X − 2/3 I2 C⁻¹),   X = I1 I − C = ∂I2/∂C
//   D  = 2 c01 a² (I⊗I − 𝕀) + Z⊗C⁻¹ + C⁻¹⊗Z + w C⁻¹⊙C⁻¹
//   Z  = −2/3 (c10 a I + 2 c01 a² X) + w'/2 C⁻¹
//   w  = 2/3 (c10 a I1 + 2 c01 a² I2),   w' = 2/9 (c10 a I1 + 4 c01 a² I2)
//
//   C    right Cauchy–Green tensor              1
//   I1, I2, I3  its principal invariants        1
//   c10, c01    constants of the law            kPa
//   𝕀    identity on symmetric tensors, A⊙A: dC -> A dC A
//
// Source: [LY1] eq:mmreng and S' of eq:mmrpktmix.
// Deviation: none; note that the shear modulus at C = I is c10 + c01, while the μ_l that [LY1]
// scales τ with is 2 (c10 + c01).

namespace {

struct Invariants {
  Sym3 C_inv;
  double I1, I2, a;
};

Invariants invariants(const Sym3& C) {
  const Sym3 adj = adjugate(C);
  const double I3 = det(C, adj);
  const double inverse = 1.0 / I3;
  Invariants inv;
  for (int I = 0; I < 6; ++I) inv.C_inv[I] = inverse * adj[I];
  inv.I1 = trace(C);
  inv.I2 = trace(adj);
  inv.a = 1.0 / std::cbrt(I3);
  return inv;
}

Sym3 stress_of(const Sym3& C, const Invariants& inv, double c10_a, double c01_a2) {
  const double on_unit = c10_a + c01_a2 * inv.I1;
  const double on_inverse = -(c10_a * inv.I1 + 2.0 * c01_a2 * inv.I2) / 3.0;
  Sym3 S;
  for (int I = 0; I < 6; ++I)
    S[I] = on_unit * unit_tensor[I] - c01_a2 * C[I] + on_inverse * inv.C_inv[I];
  return S;
}

}  // namespace

double MooneyRivlin::energy(const Sym3& C, const Frame&) const {
  const Invariants inv = invariants(C);
  return 0.5 * c10_ * (inv.I1 * inv.a - 3.0) + 0.5 * c01_ * (inv.I2 * inv.a * inv.a - 3.0);
}

Sym3 MooneyRivlin::stress(const Sym3& C, const Frame&) const {
  const Invariants inv = invariants(C);
  return stress_of(C, inv, c10_ * inv.a, c01_ * inv.a * inv.a);
}

StressTangent MooneyRivlin::response(const Sym3& C, const Frame&) const {
  const Invariants inv = invariants(C);
  const double c10_a = c10_ * inv.a;
  const double c01_a2 = c01_ * inv.a * inv.a;
  const double w = 2.0 / 3.0 * (c10_a * inv.I1 + 2.0 * c01_a2 * inv.I2);
  const double half_w1 = 1.0 / 9.0 * (c10_a * inv.I1 + 4.0 * c01_a2 * inv.I2);
  const double on_unit = -2.0 / 3.0 * (c10_a + 2.0 * c01_a2 * inv.I1);
  const double on_C = 4.0 / 3.0 * c01_a2;
  Sym3 Z;
  for (int I = 0; I < 6; ++I)
    Z[I] = on_unit * unit_tensor[I] + on_C * C[I] + half_w1 * inv.C_inv[I];

  StressTangent result;
  result.S = stress_of(C, inv, c10_a, c01_a2);
  const double e = 2.0 * c01_a2;  // 2 c01 a² (I⊗I − 𝕀) in Voigt's order
  result.D = {{{0, e, e, 0, 0, 0},
               {e, 0, e, 0, 0, 0},
               {e, e, 0, 0, 0, 0},
               {0, 0, 0, -0.5 * e, 0, 0},
               {0, 0, 0, 0, -0.5 * e, 0},
               {0, 0, 0, 0, 0, -0.5 * e}}};
  add_symmetric_product(result.D, Z, inv.C_inv);
  add_congruence(result.D, w, inv.C_inv);
  return result;
}

namespace {

Constant c10() { return {"c10", 3.0, 0.0, "kPa", "Factor of (J1 - 3)/2 in the energy."}; }
Constant c01() { return {"c01", 0.3, 0.0, "kPa", "Factor of (J2 - 3)/2 in the energy."}; }

}  // namespace

LawEntry mooney_rivlin() {
  return {"mooney-rivlin",
          "Modified Mooney-Rivlin law, c10/2 (J1 - 3) + c01/2 (J2 - 3).",
          {c10(), c01()},
          [](const Constants& value) {
            return std::make_unique<MooneyRivlin>(value.at("c10"), value.at("c01"));
          }};
}

LawEntry neo_hookean() {
  return {"neo-hookean", "Neo-Hookean law, c10/2 (J1 - 3).", {c10()}, [](const Constants& value) {
            return std::make_unique<MooneyRivlin>(value.at("c10"), 0.0);
          }};
}

}  // namespace tunica::materials
