#pragma once
#include <string>
#include <vector>

#include "tunica/base/tensor.hpp"
#include "tunica/params/table.hpp"
#include "tunica/stepping/time_function.hpp"

namespace tunica::problems {

/// What happens on one surface of the fluid.
struct FlowCondition {
  std::string surface;
  std::string kind;           ///< "traction", "pressure", "velocity", "no slip", "interface"
  Vec3 traction{};            ///< [kPa]
  double pressure = 0.0;      ///< traction −p n [kPa]
  double backflow = 0.0;      ///< β of the backflow stabilisation
  Vec3 velocity{};            ///< at the centre of the profile [mm/ms]
  bool is_parabolic = false;  ///< zero at the rim of a round surface
  stepping::TimeFunction amplitude;

  bool is_open() const { return kind == "traction" || kind == "pressure"; }
};

struct FluidOptions {
  std::vector<std::string> regions;
  double density;
  double viscosity;
  double viscous_factor;  ///< c_ν of the stabilisation parameter
  std::vector<FlowCondition> conditions;

  std::vector<std::string> interface_surfaces() const;
};

params::Table fluid_table();
/// The keys of its "Linear Solver". One sweep per level is enough: its A is mostly mass.
params::Table fluid_solver_table();
FluidOptions fluid_options(const Teuchos::ParameterList& list);

}  // namespace tunica::problems
