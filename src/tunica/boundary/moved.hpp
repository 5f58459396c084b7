#pragma once
#include "tunica/boundary/condition.hpp"
#include "tunica/stepping/time_function.hpp"

namespace tunica::boundary {

/// A surface of the wall that moves as one in some components, as if a plate were glued to it that
/// does not turn: by a displacement that is given, or under a force that it takes beside the loads
/// on it.
class Moved final : public Constraint {
public:
  /// list: the resolved list of one of the conditions below.
  Moved(const Teuchos::ParameterList& list, bool has_force);

  std::vector<CommonMotion> common_motions() const override;

private:
  std::vector<int> components_;
  Vec3 value_;  ///< [mm] or [mN]
  bool has_force_;
  stepping::TimeFunction amplitude_;
};

/// "moved" and "moves as one" of a wall.
ConditionEntry moved();
ConditionEntry moves_as_one();

}  // namespace tunica::boundary
