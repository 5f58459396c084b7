#include "tunica/materials/holzapfel.hpp"

#include <limits>

#include "tunica/materials/sym_tensor.hpp"

namespace tunica::materials {

// Fibre-reinforced arterial layer, isochoric part.
//
//   Ψ'  = Ψ'_m + Σ_i k1/(2 k2) (exp(k2 e_i²) − 1) over the families with e_i > 0
//   e_i = a H_i:C − 1,   H_i = κ_d I + (1 − 3κ_d) a_i⊗a_i,   a = I3^(−1/3)
//   a_i = cos α e_θ ± sin α e_z
//   G   = ∂e/∂C  = a (H − (H:C)/3 C⁻¹)
//   S'  = S'_m + Σ 2 k1 e exp(k2 e²) G
//   D   = D_m + Σ 4 k1 exp(k2 e²) [(1 + 2 k2 e²) G⊗G + e ∂G/∂C]
//   ∂G/∂C = −a/3 (H⊗C⁻¹ + C⁻¹⊗H) + a (H:C) (C⁻¹⊗C⁻¹/9 + C⁻¹⊙C⁻¹/3)
//
//   m     the Mooney–Rivlin matrix                            k1  kPa    k2  1
//   e     strain of a family: J_i − 1 for κ_d = 0             1
//   κ_d   dispersion; H has trace 1                           1
//   e_θ, e_z   circumferential and axial direction            α   angle  degrees
//
// Source: [LY1] eq:areng to eq:arinv46; κ_d and the condition e > 0 of [GOH].
// Deviation: [LY1] eq:arpkt prints S' without the factor 2 in the fibres; this is 2 ∂Ψ'/∂C.

namespace {

/// The unloaded state lies on the switch e = 0: round-off must not turn fibres on.
constexpr double slack = 1e-12;

/// Beyond this exponent the stress is some 1e21 k1: no solution, but a Newton step gone astray.
constexpr double largest_exponent = 50.0;

template <class Real>
struct Strain {
  Sym3Of<Real> C_inv;
  Real a;
};

template <class Real>
Strain<Real> strain_of(const Sym3Of<Real>& C) {
  using std::cbrt;
  const Inverse<Real> inverse = inverse_of(C);
  return {inverse.inverse, 1.0 / cbrt(inverse.det)};
}

template <class Real>
Real exponential(const Real& exponent) {
  using std::exp;
  return where_greater(exponent, largest_exponent, std::numeric_limits<double>::infinity(),
                       exp(exponent));
}

/// H of each family.
template <class Real>
std::array<Sym3Of<Real>, 2> structure(const HolzapfelConstants& c, const FrameOf<Real>& frame) {
  std::array<Sym3Of<Real>, 2> H;
  const double aligned = 1.0 - 3.0 * c.dispersion;
  for (int i = 0; i < 2; ++i) {
    const Vec3Of<Real> f = c.direction(frame, i);
    H[i] = {c.dispersion + aligned * f[0] * f[0],
            c.dispersion + aligned * f[1] * f[1],
            c.dispersion + aligned * f[2] * f[2],
            aligned * f[0] * f[1],
            aligned * f[1] * f[2],
            aligned * f[2] * f[0]};
  }
  return H;
}

/// What stress and tangent need of a family of fibres that carries.
template <class Real>
struct Stretch {
  Real HC, e;
  Real w;          ///< 2 k1 exp(k2 e²) a, zero where it is slack
  Sym3Of<Real> G;  ///< without a
};

/// False where the family is slack at all points.
template <class Real>
bool is_stretched(const Sym3Of<Real>& H, const Sym3Of<Real>& C, const Strain<Real>& strain,
                  const HolzapfelConstants& c, Stretch<Real>& out) {
  out.HC = contract(H, C);
  out.e = strain.a * out.HC - 1.0;
  if (!any_greater(out.e, slack)) return false;
  out.w = where_greater(out.e, slack,
                        2.0 * c.k1 * exponential<Real>(c.k2 * out.e * out.e) * strain.a, 0.0);
  for (int I = 0; I < 6; ++I) out.G[I] = H[I] - 1.0 / 3.0 * out.HC * strain.C_inv[I];
  return true;
}

template <class Real>
void add_fibre_stress(const HolzapfelConstants& c, const Sym3Of<Real>& C,
                      const FrameOf<Real>& frame, Sym3Of<Real>& S) {
  const Strain<Real> strain = strain_of(C);
  Stretch<Real> fibre;
  for (const Sym3Of<Real>& H : structure(c, frame)) {
    if (!is_stretched(H, C, strain, c, fibre)) continue;
    for (int I = 0; I < 6; ++I) S[I] += fibre.w * fibre.e * fibre.G[I];
  }
}

template <class Real>
void add_fibre_response(const HolzapfelConstants& c, const Sym3Of<Real>& C,
                        const FrameOf<Real>& frame, StressTangentOf<Real>& result) {
  const Strain<Real> strain = strain_of(C);
  const Sym3Of<Real>& C_inv = strain.C_inv;
  Stretch<Real> fibre;
  for (const Sym3Of<Real>& H : structure(c, frame)) {
    if (!is_stretched(H, C, strain, c, fibre)) continue;
    const auto& [HC, e, w, G] = fibre;
    const Real on_GG = 2.0 * w * strain.a * (1.0 + 2.0 * c.k2 * e * e);
    const Real on_dG = 2.0 * w * e;
    Sym3Of<Real> Y;  // half of what stands beside C⁻¹ in ∂G/∂C
    for (int I = 0; I < 6; ++I) {
      result.S[I] += w * e * G[I];
      Y[I] = on_dG * (1.0 / 18.0 * HC * C_inv[I] - 1.0 / 3.0 * H[I]);
      for (int J = 0; J < 6; ++J) result.D[I][J] += on_GG * G[I] * G[J];
    }
    add_symmetric_product(result.D, Y, C_inv);
    add_congruence(result.D, 1.0 / 3.0 * on_dG * HC, C_inv);
  }
}

TUNICA_PACKED void add_packed_stress(const HolzapfelConstants& c, const Sym3Of<Pack>& C,
                                     const FrameOf<Pack>& frame, Sym3Of<Pack>& S) {
  add_fibre_stress(c, C, frame, S);
}

TUNICA_PACKED void add_packed_response(const HolzapfelConstants& c, const Sym3Of<Pack>& C,
                                       const FrameOf<Pack>& frame, StressTangentOf<Pack>& result) {
  add_fibre_response(c, C, frame, result);
}

HolzapfelConstants constants_of(const Fibres& fibres) {
  const double angle = fibres.angle * std::acos(-1.0) / 180.0;
  return {fibres.k1, fibres.k2, std::cos(angle), std::sin(angle), fibres.dispersion};
}

}  // namespace

Holzapfel::Holzapfel(const MooneyRivlin& matrix, const Fibres& fibres)
    : matrix_(matrix), fibres_(constants_of(fibres)) {}

// The paper's 2 (c10 + k1/(2 k2)).
double Holzapfel::stabilisation_modulus() const {
  return matrix_.stabilisation_modulus() + fibres_.k1 / fibres_.k2;
}

std::vector<Vec3> Holzapfel::fibre_directions(const Frame& frame) const {
  return {fibres_.direction(frame, 0), fibres_.direction(frame, 1)};
}

double Holzapfel::energy(const Sym3& C, const Frame& frame) const {
  double Psi = matrix_.energy(C, frame);
  const double a = strain_of(C).a;
  for (const Sym3& H : structure(fibres_, frame)) {
    const double e = a * contract(H, C) - 1.0;
    const double exponent = fibres_.k2 * e * e;
    if (e > slack)
      Psi += 0.5 * fibres_.k1 / fibres_.k2 *
             (exponent <= largest_exponent ? std::expm1(exponent) : exponential(exponent));
  }
  return Psi;
}

Sym3 Holzapfel::stress(const Sym3& C, const Frame& frame) const {
  Sym3 S = matrix_.stress(C, frame);
  add_fibre_stress(fibres_, C, frame, S);
  return S;
}

StressTangent Holzapfel::response(const Sym3& C, const Frame& frame) const {
  StressTangent result = matrix_.response(C, frame);
  add_fibre_response(fibres_, C, frame, result);
  return result;
}

Sym3Of<Pack> Holzapfel::packed_stress(const Sym3Of<Pack>& C, const FrameOf<Pack>& frame) const {
  Sym3Of<Pack> S = matrix_.packed_stress(C, frame);
  add_packed_stress(fibres_, C, frame, S);
  return S;
}

StressTangentOf<Pack> Holzapfel::packed_response(const Sym3Of<Pack>& C,
                                                 const FrameOf<Pack>& frame) const {
  StressTangentOf<Pack> result = matrix_.packed_response(C, frame);
  add_packed_response(fibres_, C, frame, result);
  return result;
}

LawEntry holzapfel() {
  return {"holzapfel",
          "Mooney-Rivlin matrix with two families of fibres that carry tension only, "
          "k1/(2 k2) (exp(k2 e^2) - 1) each; needs the Fibre Frame.",
          {{"c10", 3.0, 0.0, "kPa", "Factor of (J1 - 3)/2 in the energy of the matrix."},
           {"c01", 0.0, 0.0, "kPa", "Factor of (J2 - 3)/2 in the energy of the matrix."},
           {"k1", 2.3632, 0.0, "kPa", "Stiffness of the fibres."},
           {"k2", 0.8393, 1e-3, "1", "Exponential stiffening of the fibres."},
           {"fibre angle", 29.0, 0.0, "deg",
            "Angle between fibres and circumference, to both sides.", 90.0},
           {"dispersion", 0.0, 0.0, "1",
            "0 for parallel fibres, 1/3 for an isotropic distribution.", 1.0 / 3.0}},
          [](const Constants& value) {
            return std::make_unique<Holzapfel>(
                MooneyRivlin(value.at("c10"), value.at("c01")),
                Fibres{value.at("k1"), value.at("k2"), value.at("fibre angle"),
                       value.at("dispersion")});
          }};
}

}  // namespace tunica::materials
