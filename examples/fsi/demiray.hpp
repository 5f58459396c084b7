#pragma once
#include <cmath>
#include <memory>
#include <tunica/materials/registry.hpp>

namespace example {

using namespace tunica;

/// Demiray's law, which stiffens exponentially (H. Demiray, Journal of Biomechanics 5 (1972)):
///
///   Ψ' = μ/(2b) (exp(b (J₁ − 3)) − 1),   J₁ = (det C)^(−1/3) tr C
///
///   μ  shear modulus at rest   kPa      b  stiffening   1
///
/// With the neo-Hookean energy N = μ/2 (J₁ − 3), its stress S_N and its tangent D_N:
///
///   φ = exp(2b N/μ),   S' = φ S_N,   D = φ (D_N + (2b/μ) S_N ⊗ S_N)
class Demiray final : public materials::HyperelasticLaw {
public:
  Demiray(double mu, double b)
      : mu_(mu), b_(b), neo_hookean_(materials::make_law("neo-hookean", {{"c10", mu}})) {}

  double energy(const Sym3& C, const materials::Frame& frame) const override {
    return 0.5 * mu_ / b_ * (factor(C, frame) - 1.0);
  }

  Sym3 stress(const Sym3& C, const materials::Frame& frame) const override {
    Sym3 S = neo_hookean_->stress(C, frame);
    const double phi = factor(C, frame);
    for (double& entry : S) entry *= phi;
    return S;
  }

  materials::StressTangent response(const Sym3& C, const materials::Frame& frame) const override {
    materials::StressTangent at = neo_hookean_->response(C, frame);
    const double phi = factor(C, frame);
    for (int I = 0; I < 6; ++I)
      for (int J = 0; J < 6; ++J)
        at.D[I][J] = phi * (at.D[I][J] + 2.0 * b_ / mu_ * at.S[I] * at.S[J]);
    for (double& entry : at.S) entry *= phi;
    return at;
  }

  double stabilisation_modulus() const override { return neo_hookean_->stabilisation_modulus(); }

private:
  double factor(const Sym3& C, const materials::Frame& frame) const {
    return std::exp(2.0 * b_ / mu_ * neo_hookean_->energy(C, frame));
  }

  double mu_, b_;
  std::unique_ptr<materials::HyperelasticLaw> neo_hookean_;
};

/// "demiray" of a layer of the wall.
inline materials::LawEntry demiray() {
  return {
      "demiray",
      "Demiray's law, which stiffens exponentially.",
      {{"mu", 30.0, 1e-6, "kPa", "Shear modulus at rest."}, {"b", 1.0, 1e-6, "1", "Stiffening."}},
      [](const materials::Constants& value) {
        return std::make_unique<Demiray>(value.at("mu"), value.at("b"));
      }};
}

}  // namespace example
