#include "tunica/discretisation/fluid_options.hpp"

#include <Teuchos_Array.hpp>

#include "tunica/base/error.hpp"
#include "tunica/boundary/registry.hpp"
#include "tunica/discretisation/law_keys.hpp"
#include "tunica/materials/viscosity_registry.hpp"
#include "tunica/stepping/registry.hpp"

namespace tunica::discretisation {

namespace {

// The constants of a law of viscosity are keys where that law is chosen.
void add_viscosity_keys(params::Table& table) {
  std::vector<params::Table::Case> laws;
  for (const materials::ViscosityEntry& law : materials::viscosity_laws()) {
    params::Table keys(law.sentence);
    add_constant_keys(law.constants, keys);
    laws.push_back({law.name, keys});
  }
  table.variant("law", laws.front().value, laws,
                "law of the viscosity: its dependence on the shear rate");
}

}  // namespace

void add_fluid_keys(params::Table& table) {
  table.names("regions", std::vector<std::string>{"fluid"}, "regions of the mesh that are fluid")
      .number("density", std::nullopt, params::positive(), "mg/mm^3", "density");
  add_viscosity_keys(table);
  table
      .choice("stabilisation", "tracked", {"tracked", "dynamic", "inertial"},
              "subscales of SUPG and PSPG: time-dependent, which keep the pressure stable as the "
              "time step shrinks, with their inertia in the force on walls (tracked) or without it "
              "(dynamic); or quasi-static, with the time step in their parameter only (inertial)")
      .choice(
          "stabilisation residual", "viscous", {"viscous", "linear"},
          "residual that drives the subscales: with its viscous part, recovered from the strain "
          "rates around each vertex (viscous), or without it, as on linear elements (linear)")
      .choice("stabilisation velocity", "predicted", {"predicted", "past"},
              "the velocity in the SUPG and PSPG parameter: extrapolated to the new time, or that "
              "of the past from which the time scheme starts its step")
      .choice(
          "stabilisation within elements", "automatic", {"automatic", "varying", "mean"},
          "SUPG with the residual as it varies within an element, or with its mean, which alone "
          "drives time-dependent subscales: with these, only the mean preserves the order of "
          "second-order schemes at small steps; automatic: the mean if subscales are dynamic")
      .choice("convection", "advective", {"advective", "skew-symmetric"},
              "as the equations are written (advective); or with the additional term rho/2 (div u) "
              "u, which vanishes in the exact solution, so that discrete convection neither "
              "dissipates nor produces energy (skew-symmetric)")
      .number("stabilisation viscous factor", 4.0, params::positive(), "1",
              "c of the viscous part c nu/h^2 in the SUPG and PSPG parameter; with the linear "
              "residual 12 is more accurate in slow viscous flow, where 4 smears the pressure")
      .entries("Surfaces",
               boundary::condition_table(
                   "One surface of the fluid. Surfaces that are not listed are free outlets.",
                   boundary::fluid_conditions()),
               "one list for each surface with a condition");
  stepping::add_fluid_scheme_keys(table);
  table.check([](const Teuchos::ParameterList& list, const std::string& path) {
    TUNICA_CHECK(!list.get<Teuchos::Array<std::string>>("regions").empty(),
                 path + ": \"regions\" is empty. Name each region of the fluid.");
  });
}

namespace {

// A resolved list holds the constants of its own law only.
std::shared_ptr<const materials::ViscosityLaw> viscosity_of(const Teuchos::ParameterList& list) {
  const auto& name = list.get<std::string>("law");
  materials::Constants constants;
  for (const materials::ViscosityEntry& law : materials::viscosity_laws())
    if (law.name == name) constants = constants_in(list, law.constants);
  return materials::make_viscosity_law(name, constants);
}

}  // namespace

FluidOptions fluid_options(const Teuchos::ParameterList& list) {
  FluidOptions options;
  options.regions = list.get<Teuchos::Array<std::string>>("regions").toVector();
  options.density = list.get<double>("density");
  options.viscosity = viscosity_of(list);
  const auto& stabilisation = list.get<std::string>("stabilisation");
  options.has_dynamic_subscales = stabilisation != "inertial";
  options.has_inertia_on_walls = stabilisation == "tracked";
  options.has_viscous_residual = list.get<std::string>("stabilisation residual") == "viscous";
  options.has_predicted_tau = list.get<std::string>("stabilisation velocity") == "predicted";
  options.has_skew_convection = list.get<std::string>("convection") == "skew-symmetric";
  // Subscales in time carry the mean residual. What varies within an element stays multiplied by τ,
  // vanishes at first order in Δt, and no scheme of higher order mends it.
  const auto& within = list.get<std::string>("stabilisation within elements");
  options.has_mean_residual =
      within == "mean" || (within == "automatic" && options.has_dynamic_subscales);
  options.viscous_factor = list.get<double>("stabilisation viscous factor");
  options.conditions = boundary::conditions_of(list.sublist("Surfaces"));
  // The list is copied, as the field makes its scheme later.
  options.make_scheme = [list] { return stepping::make_fluid_scheme(list); };
  return options;
}

}  // namespace tunica::discretisation
