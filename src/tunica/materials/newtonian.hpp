#pragma once
#include "tunica/materials/viscosity_registry.hpp"

namespace tunica::materials {

/// A viscosity that is the same at all shear rates.
class Newtonian final : public ViscosityLaw {
public:
  explicit Newtonian(double viscosity) : viscosity_(viscosity) {}

  Viscosity at(double) const override { return {viscosity_, 0.0}; }
  bool is_constant() const override { return true; }
  double reference() const override { return viscosity_; }

private:
  double viscosity_;
};

/// "newtonian" of a fluid.
ViscosityEntry newtonian();

}  // namespace tunica::materials
