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

template <class Real>
struct Invariants {
  Sym3Of<Real> C_inv;
  Real I1, I2, a;
};

template <class Real>
Invariants<Real> invariants(const Sym3Of<Real>& C) {
  using std::cbrt;
  const Sym3Of<Real> adj = adjugate(C);
  const Real I3 = det(C, adj);
  const Real inverse = 1.0 / I3;
  Invariants<Real> inv;
  for (int I = 0; I < 6; ++I) inv.C_inv[I] = inverse * adj[I];
  inv.I1 = trace(C);
  inv.I2 = trace(adj);
  inv.a = 1.0 / cbrt(I3);
  return inv;
}

template <class Real>
Sym3Of<Real> stress_of(const Sym3Of<Real>& C, const Invariants<Real>& inv, const Real& c10_a,
                       const Real& c01_a2) {
  const Real on_unit = c10_a + c01_a2 * inv.I1;
  const Real on_inverse = -1.0 / 3.0 * (c10_a * inv.I1 + 2.0 * c01_a2 * inv.I2);
  Sym3Of<Real> S;
  for (int I = 0; I < 6; ++I)
    S[I] = on_unit * unit_tensor[I] - c01_a2 * C[I] + on_inverse * inv.C_inv[I];
  return S;
}

template <class Real>
Sym3Of<Real> stress_at(double c10, double c01, const Sym3Of<Real>& C) {
  const Invariants<Real> inv = invariants(C);
  return stress_of<Real>(C, inv, c10 * inv.a, c01 * inv.a * inv.a);
}

template <class Real>
StressTangentOf<Real> response_at(double c10, double c01, const Sym3Of<Real>& C) {
  const Invariants<Real> inv = invariants(C);
  const Real c10_a = c10 * inv.a;
  const Real c01_a2 = c01 * inv.a * inv.a;
  const Real w = 2.0 / 3.0 * (c10_a * inv.I1 + 2.0 * c01_a2 * inv.I2);
  const Real half_w1 = 1.0 / 9.0 * (c10_a * inv.I1 + 4.0 * c01_a2 * inv.I2);
  const Real on_unit = -2.0 / 3.0 * (c10_a + 2.0 * c01_a2 * inv.I1);
  const Real on_C = 4.0 / 3.0 * c01_a2;
  Sym3Of<Real> Z;
  for (int I = 0; I < 6; ++I)
    Z[I] = on_unit * unit_tensor[I] + on_C * C[I] + half_w1 * inv.C_inv[I];

  StressTangentOf<Real> result;
  result.S = stress_of(C, inv, c10_a, c01_a2);
  const Real e = 2.0 * c01_a2;  // 2 c01 a² (I⊗I − 𝕀) in Voigt's order
  const Real f = -0.5 * e, o = 0.0;
  result.D = {{{o, e, e, o, o, o},
               {e, o, e, o, o, o},
               {e, e, o, o, o, o},
               {o, o, o, f, o, o},
               {o, o, o, o, f, o},
               {o, o, o, o, o, f}}};
  add_symmetric_product(result.D, Z, inv.C_inv);
  add_congruence(result.D, w, inv.C_inv);
  return result;
}

TUNICA_PACKED void find_packed_stress(double c10, double c01, const Sym3Of<Pack>& C,
                                      Sym3Of<Pack>& S) {
  S = stress_at(c10, c01, C);
}

TUNICA_PACKED void find_packed_response(double c10, double c01, const Sym3Of<Pack>& C,
                                        StressTangentOf<Pack>& result) {
  result = response_at(c10, c01, C);
}

}  // namespace

double MooneyRivlin::energy(const Sym3& C, const Frame&) const {
  const Invariants<double> inv = invariants(C);
  return 0.5 * c10_ * (inv.I1 * inv.a - 3.0) + 0.5 * c01_ * (inv.I2 * inv.a * inv.a - 3.0);
}

Sym3 MooneyRivlin::stress(const Sym3& C, const Frame&) const { return stress_at(c10_, c01_, C); }

StressTangent MooneyRivlin::response(const Sym3& C, const Frame&) const {
  return response_at(c10_, c01_, C);
}

Sym3Of<Pack> MooneyRivlin::packed_stress(const Sym3Of<Pack>& C, const FrameOf<Pack>&) const {
  Sym3Of<Pack> S;
  find_packed_stress(c10_, c01_, C, S);
  return S;
}

StressTangentOf<Pack> MooneyRivlin::packed_response(const Sym3Of<Pack>& C,
                                                    const FrameOf<Pack>&) const {
  StressTangentOf<Pack> result;
  find_packed_response(c10_, c01_, C, result);
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
