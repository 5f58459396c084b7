#pragma once
#include "tunica/boundary/condition.hpp"

namespace tunica::boundary {

/// Components of the vector unknown, displacement or velocity, that stay zero; all of them where a
/// wall is clamped. Or the one along the normal of a plane, so that its nodes slide in it.
class Held final : public Constraint {
public:
  /// directions: of length 1.
  explicit Held(std::vector<int> components, std::vector<Vec3> directions = {})
      : components_(std::move(components)), directions_(std::move(directions)) {}
  std::vector<int> prescribed_components() const override { return components_; }
  bool prescribes_zero() const override { return true; }
  std::vector<Vec3> held_directions() const override { return directions_; }

private:
  std::vector<int> components_;
  std::vector<Vec3> directions_;
};

/// The "components" of a resolved list, as numbers; and the check of the key.
std::vector<int> components_of(const Teuchos::ParameterList& list);
void check_components(const Teuchos::ParameterList& list, const std::string& path);

/// "clamped", "held" and "interface" of a wall; on the last the fluid's force comes from outside.
ConditionEntry clamped();
ConditionEntry held();
ConditionEntry loaded_by_fluid();
/// "held" of a fluid.
ConditionEntry held_velocity();

}  // namespace tunica::boundary
