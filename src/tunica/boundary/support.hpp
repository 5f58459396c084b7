#pragma once
#include "tunica/boundary/condition.hpp"

namespace tunica::boundary {

/// The tissue around a wall, as a bed of springs and dashpots:
///
///   R[a] += ∫ N_a P (k (d + o) + c v) dA,   K[a][b] += (k + c ∂v/∂d) P ∫ N_a N_b dA
///
///   k  stiffness   kPa/mm      c  damping   kPa ms/mm      d, v  displacement and velocity
///   P  N⊗N with the unit normal N of the undeformed surface, or the unit tensor
///   o  stretch of the springs on the undeformed surface, where a prestress has found one; else 0
///
/// Source: [MX1], with P the unit tensor.
class Support final : public FaceLoad, public WholeLoad, public Remembering {
public:
  /// list: a resolved list of support_condition().
  Support(const Teuchos::ParameterList& list, const fields::FieldMesh& mesh, int surface);

  void add(const Surroundings& s, const fields::Face& face, assembly::NodalResidual& R,
           assembly::BlockAssembler* K) const override;
  std::vector<Vec3> sprung_directions(const fields::FieldMesh& mesh,
                                      const fields::Face& face) const override;
  /// support_energy_SURFACE: ½ ∫ k (d + o)·P (d + o) dA; support_power_SURFACE: ∫ c v·P v dA;
  /// support_force_SURFACE: of the tissue on the wall [mN].
  void observe_whole(const Surroundings& s, std::map<std::string, double>& found) const override;
  void follow(const stepping::TimeScheme& scheme) override { scheme_ = &scheme; }

private:
  /// Energy, power and force of one face.
  std::array<double, 5> sums_of(const Surroundings& s, const fields::Face& face) const;

  std::string name_;
  int surface_;
  double stiffness_, damping_;
  bool is_normal_;
  const stepping::TimeScheme* scheme_ = nullptr;
};

/// "support" of a wall, with the pressure outside.
ConditionEntry support_condition();

}  // namespace tunica::boundary
