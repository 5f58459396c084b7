#pragma once
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "tunica/boundary/registry.hpp"
#include "tunica/stepping/time_scheme.hpp"

namespace tunica::materials {
class ViscosityLaw;
}

namespace tunica::discretisation {

/// Options of the discretisation in a resolved "Fluid" list.
struct FluidOptions {
  std::vector<std::string> regions;
  double density;
  std::shared_ptr<const materials::ViscosityLaw> viscosity;
  bool has_dynamic_subscales;  ///< they have inertia of their own
  bool has_inertia_on_walls;   ///< which the force on walls contains
  bool has_viscous_residual;   ///< subscales see the viscous force
  bool has_predicted_tau;      ///< τ takes the velocity expected at the new time, not the past
  bool has_skew_convection;    ///< convection takes out no energy
  bool has_mean_residual;      ///< SUPG has only the mean of an element's residual
  double viscous_factor;       ///< c_ν of the stabilisation parameter
  std::vector<boundary::Condition> conditions;
  std::function<std::unique_ptr<stepping::TimeScheme>()> make_scheme;
};

/// Adds the keys of a "Fluid" list that its discretisation has.
void add_fluid_keys(params::Table& table);
FluidOptions fluid_options(const Teuchos::ParameterList& list);

}  // namespace tunica::discretisation
