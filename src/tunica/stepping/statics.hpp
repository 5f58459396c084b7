#pragma once
#include "tunica/stepping/time_scheme.hpp"

namespace tunica::stepping {

/// A sequence of equilibria: nothing has a velocity or inertia.
class Statics final : public TimeScheme {
public:
  std::vector<std::string> remembers() const override { return {"velocity"}; }
  double rate() const override { return 0.0; }
  double past(const Timeline& x, int i) const override { return x.value()[i]; }
  double prediction(const Timeline& x, int i) const override { return x.value()[i]; }
  double inertia(double) const override { return 0.0; }
  double inertia_load(const Timeline&, int) const override { return 0.0; }
  void accept(Rows now, Timeline& x) const override { x.push(std::move(now)); }
  int order() const override { return 1; }
  /// None: an equilibrium knows no other.
  ErrorFormula value_error(const StepSizes&) const override { return {0, 0.0}; }
};

}  // namespace tunica::stepping
