#pragma once
#include <optional>

#include "tunica/boundary/condition.hpp"
#include "tunica/boundary/surface_geometry.hpp"
#include "tunica/stepping/time_function.hpp"

namespace tunica::boundary {

/// All components of the fluid's velocity are given, where the surface was undeformed.
class GivenVelocity : public Constraint {
public:
  bool keeps_place() const override { return true; }
  std::vector<int> prescribed_components() const override { return {0, 1, 2}; }
};

/// A velocity in time, the same everywhere or parabolic with zero at the rim of a round surface.
class PrescribedVelocity final : public GivenVelocity {
public:
  /// list: a resolved list with "velocity" [mm/ms], "profile" and "Amplitude". Collective.
  PrescribedVelocity(const Teuchos::ParameterList& list, const fields::FieldMesh& mesh,
                     int surface);

  bool wants_whole_section() const override { return round_.has_value(); }
  bool sticks() const override { return norm(velocity_) == 0.0; }
  Vec3 prescribed(const Surroundings& s, int node) const override;
  int precedence() const override { return 1; }

private:
  Vec3 velocity_;                         ///< at the centre of the profile [mm/ms]
  std::optional<SurfaceGeometry> round_;  ///< of a parabolic profile
  stepping::TimeFunction amplitude_;
};

/// No velocity.
class NoSlip final : public GivenVelocity {
public:
  bool sticks() const override { return true; }
  int precedence() const override { return 2; }
};

/// The fluid sticks to what moves its mesh: u = w.
class InterfaceVelocity final : public GivenVelocity {
public:
  bool sticks() const override { return true; }
  Vec3 prescribed(const Surroundings& s, int node) const override { return (*s.w)[node]; }
  int precedence() const override { return 3; }
};

/// "velocity", "no slip" and "interface" of a fluid.
ConditionEntry velocity_condition();
ConditionEntry no_slip();
ConditionEntry moves_with_wall();

}  // namespace tunica::boundary
