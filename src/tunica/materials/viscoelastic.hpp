#pragma once
#include <memory>

#include "tunica/materials/wall_law.hpp"

namespace tunica::materials {

/// An elastic law with a Maxwell element beside it (finite linear viscoelasticity):
///
///   S' = S_e(C) + Q,   Q̇ + Q/τ = β Ṡ_e
///   Q = e^(−Δt/τ) Qⁿ⁻¹ + β e^(−Δt/(2τ)) (S_e − S_eⁿ⁻¹)      exact at constant rates to O(Δt²)
///
///   S_e  stress of the elastic law, which is left in equilibrium   kPa      τ  relaxation time ms
///   Q    stress that fades                                         kPa      β  its part of S_e   1
///
/// A sudden stretch thus meets (1 + β) S_e. Remembers Q and S_e. Source: [Sim].
class Viscoelastic final : public WallLaw {
public:
  Viscoelastic(std::unique_ptr<WallLaw> elastic, double viscous_fraction, double relaxation_time)
      : elastic_(std::move(elastic)), beta_(viscous_fraction), tau_(relaxation_time) {}

  int state_width() const override { return 12; }
  /// That of the elastic law.
  double energy(const Sym3& C, const Frame& frame, const Past& past) const override {
    return elastic_->energy(C, frame, past);
  }
  Sym3 stress(const Sym3& C, const Frame& frame, const Past& past) const override;
  StressTangent response(const Sym3& C, const Frame& frame, const Past& past) const override;
  Sym3Of<Pack> packed_stress(const Sym3Of<Pack>& C, const FrameOf<Pack>& frame,
                             const PackedPast& past) const override;
  StressTangentOf<Pack> packed_response(const Sym3Of<Pack>& C, const FrameOf<Pack>& frame,
                                        const PackedPast& past) const override;
  void remember(const Sym3& C, const Frame& frame, const Past& past, double* state) const override;

  double stabilisation_modulus() const override {
    return (1.0 + beta_) * elastic_->stabilisation_modulus();
  }
  bool has_fibres() const override { return elastic_->has_fibres(); }
  std::vector<Vec3> fibre_directions(const Frame& frame) const override {
    return elastic_->fibre_directions(frame);
  }

private:
  /// β e^(−Δt/(2τ)), zero in equilibrium.
  double factor(const Past& past) const;
  /// Q of the step that ends with S_e.
  Sym3 fading_stress(const Sym3& elastic, const Past& past) const;

  /// S_e + Q of it.
  void add_fading_stress(Sym3& S, const Past& past) const;
  void add_fading_stress(Sym3Of<Pack>& S, const PackedPast& past) const;

  std::unique_ptr<WallLaw> elastic_;
  double beta_, tau_;
};

}  // namespace tunica::materials
