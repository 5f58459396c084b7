#pragma once
#include "tunica/stepping/time_scheme.hpp"

namespace tunica::stepping {

/// A sequence of equilibria: nothing has a velocity or inertia.
class Statics final : public TimeScheme {
public:
  std::vector<std::string> remembers() const override { return {"velocity"}; }
  double rate() const override { return 0.0; }
  Vec3 past(const History& history, int node) const override { return history.value()[node]; }
  Vec3 prediction(const History& history, int node) const override { return history.value()[node]; }
  double inertia(double) const override { return 0.0; }
  Vec3 inertia_load(const History&, int) const override { return {}; }
  void accept(const std::vector<Vec3>& x, History& history) const override { history.value() = x; }
  int order() const override { return 1; }
  /// None: an equilibrium knows no other.
  ErrorFormula value_error(const StepSizes&) const override { return {0, 0.0}; }
};

}  // namespace tunica::stepping
