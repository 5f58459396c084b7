#pragma once
#include <complex>

#include "tunica/boundary/cap.hpp"
#include "tunica/boundary/prescribed_velocity.hpp"

namespace tunica::boundary {

/// A flow rate Q(t) into the fluid, along the normal of a surface of any shape:
///
///   u = −Q(t) φ n,   ∫ φ dA = 1,
///   u = −n Re Σ_k Q_k φ_k e^{ikωt}   of a Womersley profile, Q = Re Σ_k Q_k e^{ikωt}
///
///   n  mean normal of the undeformed surface, out of the fluid     1
///   φ  the profile: flat, that of a steady flow in a long pipe of this section, or of each
///      harmonic k of the flow rate its own                     1/mm²
///
/// φ vanishes on the rim, where conditions of other surfaces hold, but for planes of symmetry:
/// beyond these the section goes on, and Q is what flows through the part that the mesh has. As the
/// surface grows φ shrinks, so that the flow rate of u through the present surface, along the
/// undeformed normal, stays what is given; what the profiles miss where it grows unevenly has that
/// of the steady flow. The remainder of Q(t) beyond K harmonics has the profile of the steady flow.
class FlowRate final : public GivenVelocity, public SectionProfile {
public:
  /// list: a resolved list of flow_rate_condition(). mesh must outlive the object.
  FlowRate(const Teuchos::ParameterList& list, const fields::FieldMesh& mesh, int surface);
  /// Throws Error where no node lies within the rim. Collective.
  void make_profile(const std::vector<int>& planes) override;

  bool keeps_place() const override { return false; }  // profiles stretch with the cap
  void prepare(const Surroundings& s) override;
  Vec3 prescribed(const Surroundings& s, int node) const override;
  int surface() const override { return surface_; }
  int precedence() const override { return 1; }

private:
  void find_harmonics(double nu);
  /// Along −n at the nodes of the cap, on the undeformed surface [mm/ms].
  std::vector<double> speeds(double time) const;
  /// Inflow through the present surface with these speeds at the cap's nodes, and with others
  /// [mm³/ms]. Collective.
  std::array<double, 2> flows(const Surroundings& s, const std::vector<double>& speed,
                              const std::vector<double>& other) const;

  const fields::FieldMesh* mesh_;
  int surface_;
  double flow_rate_;  ///< [mm³/ms]
  bool is_flat_;
  stepping::TimeFunction amplitude_;
  int n_harmonics_;  ///< K; zero where all have one profile
  Cap cap_;
  Vec3 normal_;
  Profile steady_;
  std::vector<int> place_;  ///< of owned nodes: in the cap
  std::vector<std::complex<double>> Q_;
  std::vector<ComplexProfile> phi_;  ///< from k = 1
  std::vector<double> speed_;        ///< at the nodes of the cap, as prepare() left it
};

/// "flow rate" of a fluid.
ConditionEntry flow_rate_condition();

}  // namespace tunica::boundary
