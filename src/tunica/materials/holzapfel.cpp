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

struct Strain {
  Sym3 C_inv;
  double a;
};

Strain strain_of(const Sym3& C) {
  const auto [C_inv, I3] = inverse_of(C);
  return {C_inv, 1.0 / std::cbrt(I3)};
}

double exponential(double exponent) {
  return exponent <= largest_exponent ? std::exp(exponent)
                                      : std::numeric_limits<double>::infinity();
}

/// G without a.
Sym3 direction(const Sym3& H, double HC, const Sym3& C_inv) {
  Sym3 G;
  for (int I = 0; I < 6; ++I) G[I] = H[I] - HC / 3.0 * C_inv[I];
  return G;
}

/// What stress and tangent need of a family of fibres that carries.
struct Stretch {
  double HC, e;
  double w;  ///< 2 k1 exp(k2 e²) a
  Sym3 G;
};

/// False where the family is slack.
bool is_stretched(const Sym3& H, const Sym3& C, const Strain& strain, double k1, double k2,
                  Stretch& out) {
  out.HC = contract(H, C);
  out.e = strain.a * out.HC - 1.0;
  if (!(out.e > slack)) return false;
  out.w = 2.0 * k1 * exponential(k2 * out.e * out.e) * strain.a;
  out.G = direction(H, out.HC, strain.C_inv);
  return true;
}

}  // namespace

Holzapfel::Holzapfel(const MooneyRivlin& matrix, const Fibres& fibres)
    : matrix_(matrix), k1_(fibres.k1), k2_(fibres.k2),
      cos_angle_(std::cos(fibres.angle * std::acos(-1.0) / 180.0)),
      sin_angle_(std::sin(fibres.angle * std::acos(-1.0) / 180.0)), dispersion_(fibres.dispersion) {
}

// The paper's 2 (c10 + k1/(2 k2)).
double Holzapfel::stabilisation_modulus() const {
  return matrix_.stabilisation_modulus() + k1_ / k2_;
}

Vec3 Holzapfel::direction(const Frame& frame, int family) const {
  return cos_angle_ * frame.circumferential +
         (family == 0 ? sin_angle_ : -sin_angle_) * frame.axial;
}

std::vector<Vec3> Holzapfel::fibre_directions(const Frame& frame) const {
  return {direction(frame, 0), direction(frame, 1)};
}

std::array<Sym3, 2> Holzapfel::structure(const Frame& frame) const {
  std::array<Sym3, 2> H;
  for (int i = 0; i < 2; ++i) {
    const Vec3 f = direction(frame, i);
    const double aligned = 1.0 - 3.0 * dispersion_;
    H[i] = {dispersion_ + aligned * f[0] * f[0],
            dispersion_ + aligned * f[1] * f[1],
            dispersion_ + aligned * f[2] * f[2],
            aligned * f[0] * f[1],
            aligned * f[1] * f[2],
            aligned * f[2] * f[0]};
  }
  return H;
}

double Holzapfel::energy(const Sym3& C, const Frame& frame) const {
  double Psi = matrix_.energy(C, frame);
  const double a = strain_of(C).a;
  for (const Sym3& H : structure(frame)) {
    const double e = a * contract(H, C) - 1.0;
    const double exponent = k2_ * e * e;
    if (e > slack)
      Psi += 0.5 * k1_ / k2_ *
             (exponent <= largest_exponent ? std::expm1(exponent) : exponential(exponent));
  }
  return Psi;
}

Sym3 Holzapfel::stress(const Sym3& C, const Frame& frame) const {
  Sym3 S = matrix_.stress(C, frame);
  const Strain strain = strain_of(C);
  Stretch fibre;
  for (const Sym3& H : structure(frame)) {
    if (!is_stretched(H, C, strain, k1_, k2_, fibre)) continue;
    for (int I = 0; I < 6; ++I) S[I] += fibre.w * fibre.e * fibre.G[I];
  }
  return S;
}

StressTangent Holzapfel::response(const Sym3& C, const Frame& frame) const {
  StressTangent result = matrix_.response(C, frame);
  const Strain strain = strain_of(C);
  const auto& [C_inv, a] = strain;
  Stretch fibre;
  for (const Sym3& H : structure(frame)) {
    if (!is_stretched(H, C, strain, k1_, k2_, fibre)) continue;
    const auto& [HC, e, w, G] = fibre;
    const double on_GG = 2.0 * w * a * (1.0 + 2.0 * k2_ * e * e);
    const double on_dG = 2.0 * w * e;
    Sym3 Y;  // half of what stands beside C⁻¹ in ∂G/∂C
    for (int I = 0; I < 6; ++I) {
      result.S[I] += w * e * G[I];
      Y[I] = on_dG * (HC / 18.0 * C_inv[I] - H[I] / 3.0);
      for (int J = 0; J < 6; ++J) result.D[I][J] += on_GG * G[I] * G[J];
    }
    add_symmetric_product(result.D, Y, C_inv);
    add_congruence(result.D, on_dG * HC / 3.0, C_inv);
  }
  return result;
}

LawEntry holzapfel() {
  return {"holzapfel",
          "Mooney-Rivlin matrix with two families of fibres that carry tension only, "
          "k1/(2 k2) (exp(k2 e^2) - 1) each; needs the Fibre Frame.",
          {{"c10", 3.0, 0.0, "kPa", "Factor of (J1 - 3)/2 in the energy of the matrix."},
           {"c01", 0.0, 0.0, "kPa", "Factor of (J2 - 3)/2 in the energy of the matrix."},
           {"k1", 2.3632, 0.0, "kPa", "Stiffness of the fibres."},
           {"k2", 0.8393, 1e-3, "1", "How fast the fibres stiffen."},
           {"fibre angle", 29.0, 0.0, "deg",
            "Between fibres and circumference, towards both sides.", 90.0},
           {"dispersion", 0.0, 0.0, "1", "0 for parallel fibres, 1/3 for no direction at all.",
            1.0 / 3.0}},
          [](const Constants& value) {
            return std::make_unique<Holzapfel>(
                MooneyRivlin(value.at("c10"), value.at("c01")),
                Fibres{value.at("k1"), value.at("k2"), value.at("fibre angle"),
                       value.at("dispersion")});
          }};
}

}  // namespace tunica::materials
