#pragma once
#include <optional>

#include "tunica/boundary/condition.hpp"
#include "tunica/stepping/time_scheme.hpp"

namespace tunica::boundary {

/// Three-element Windkessel behind an outlet: a resistance, followed by a compliance parallel to a
/// second resistance.
///
///   σ n = −p n,   p = R_p Q + p_c,   C dp_c/dt = Q − (p_c − p_d)/R_d,   Q = ∫ c·n da
///
///   R[a] += p a_a,   K[a][b] += dp/dQ a_a a_bᵀ,   Q = Σ_a a_a·c_a,   a_a = ∫ N_a n da
///
///   Q    flow out of the surface     mm³/ms     c    u − w, velocity through it       mm/ms
///   R_p  proximal resistance     kPa ms/mm³     p_c  stored pressure                     kPa
///   R_d  distal resistance       kPa ms/mm³     p_d  distal pressure                     kPa
///   C    capacitance                mm³/kPa
///
/// With the time scheme's dp_c/dt = r (p_c − p̃_c) and θ = r R_d C
///
///   p_c = (R_d Q + θ p̃_c + p_d)/(1 + θ),   dp/dQ = R_p + R_d/(1 + θ);
///
/// C = 0 leaves a resistance R_p + R_d. The flow counts where the surface lies at present, and what
/// a moving surface sweeps does not pass it. Source: [VC1], coupled implicitly.
class Windkessel final : public WholeLoad, public Remembering {
public:
  /// list: a resolved list of windkessel_condition().
  Windkessel(const Teuchos::ParameterList& list, const fields::FieldMesh& mesh, int surface);

  int rank() const override { return 1; }
  void add_whole(const Surroundings& s, assembly::NodalResidual& R,
                 assembly::BlockAssembler* K) const override;
  /// p ∂a_a/∂x + dp/dQ a_a (∂Q/∂x)ᵀ.
  void add_whole_shape(const Surroundings& s, assembly::FluidShapeMatrix& S) const override;
  /// pressure_SURFACE_kPa: p; stored_pressure_SURFACE_kPa: p_c; to traction_power −p ∫ u·n da.
  void observe_whole(const Surroundings& s, std::map<std::string, double>& found) const override;

  // its state: p_c as the time scheme remembers it
  void follow(const stepping::TimeScheme& scheme) override;
  void begin_step() override;
  void end_step(const Surroundings& s) override;
  std::vector<double> state() const override;
  void restore(const std::vector<double>& state) override;

private:
  double flow(const Surroundings& s, const std::vector<Vec3>& area) const;
  /// p_c of a flow in the present step.
  double stored(double flow) const { return known_ + slope_ * flow; }

  std::string name_;
  int surface_;
  double proximal_, capacitance_, distal_, distal_pressure_, initial_pressure_;

  const stepping::TimeScheme* scheme_ = nullptr;
  std::optional<stepping::Timeline> stored_;  ///< p_c
  double known_, slope_ = 0.0;                ///< p_c = known + slope Q
};

/// "windkessel" and "resistance" of a fluid, with backflow stabilisation.
ConditionEntry windkessel_condition();
ConditionEntry resistance_condition();

}  // namespace tunica::boundary
