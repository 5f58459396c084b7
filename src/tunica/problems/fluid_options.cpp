#include "tunica/problems/fluid_options.hpp"

#include <Teuchos_Array.hpp>

#include "tunica/base/error.hpp"
#include "tunica/linear/linear_solver.hpp"
#include "tunica/nonlinear/newton.hpp"

namespace tunica::problems {

namespace {

void add_backflow(params::Table& table) {
  table.number("backflow stabilisation", 0.0, params::non_negative(), "1",
               "factor β of the term that takes out the energy which inflow through an open "
               "surface brings in; 0 is the paper's choice, 0.2 is safe");
}

params::Table condition_table() {
  params::Table traction, pressure, velocity;
  traction.numbers("traction", std::nullopt, params::any(), 3, "kPa",
                   "σ n on the surface; zeros let the fluid out freely");
  add_backflow(traction);
  traction.sublist("Amplitude", stepping::time_function_table());
  pressure.number("pressure", std::nullopt, params::any(), "kPa", "p of the traction -p n");
  add_backflow(pressure);
  pressure.sublist("Amplitude", stepping::time_function_table());
  velocity
      .numbers("velocity", std::nullopt, params::any(), 3, "mm/ms",
               "velocity, at the centre if the profile is parabolic")
      .choice("profile", "uniform", {"uniform", "parabolic"},
              "the same everywhere, or parabolic with zero at the rim of a round surface")
      .sublist("Amplitude", stepping::time_function_table());
  params::Table table(
      "One surface of the fluid. Surfaces that are not listed let the fluid out freely.");
  table.variant("condition", std::nullopt,
                {{"traction", traction},
                 {"pressure", pressure},
                 {"velocity", velocity},
                 {"no slip", params::Table("no velocity")},
                 {"interface", params::Table("moves with the wall")}},
                "what happens on the surface");
  return table;
}

FlowCondition condition_of(const std::string& surface, const Teuchos::ParameterList& list) {
  FlowCondition condition;
  condition.surface = surface;
  condition.kind = list.get<std::string>("condition");
  const auto vector = [&list](const std::string& key) {
    const auto& v = list.get<Teuchos::Array<double>>(key);
    return Vec3{v[0], v[1], v[2]};
  };
  if (condition.kind == "traction") condition.traction = vector("traction");
  if (condition.kind == "pressure") condition.pressure = list.get<double>("pressure");
  if (condition.is_open()) condition.backflow = list.get<double>("backflow stabilisation");
  if (condition.kind == "velocity") {
    condition.velocity = vector("velocity");
    condition.is_parabolic = list.get<std::string>("profile") == "parabolic";
  }
  if (list.isSublist("Amplitude"))
    condition.amplitude = stepping::TimeFunction(list.sublist("Amplitude"));
  return condition;
}

}  // namespace

params::Table fluid_solver_table() { return linear::linear_solver_table({"multigrid"}); }

params::Table fluid_table() {
  params::Table table("The fluid: ALE Navier-Stokes, P1-P1 with SUPG and PSPG, implicit Euler.");
  table.names("regions", std::vector<std::string>{"fluid"}, "regions of the mesh that are fluid")
      .number("density", std::nullopt, params::positive(), "mg/mm^3", "density")
      .number("viscosity", std::nullopt, params::positive(), "kPa ms",
              "dynamic viscosity; 0.035 Poise are 3.5e-6 kPa s = 3.5e-3 kPa ms")
      .number("stabilisation viscous factor", 4.0, params::positive(), "1",
              "c of the viscous part c nu/h^2 in the SUPG and PSPG parameter; 12 is more accurate "
              "in slow viscous flow at large time steps, where 4 blurs the pressure")
      .entries("Surfaces", condition_table(), "one list for each surface with a condition")
      .sublist("Newton", nonlinear::newton_table())
      .sublist("Linear Solver", fluid_solver_table())
      .check([](const Teuchos::ParameterList& list, const std::string& path) {
        TUNICA_CHECK(!list.get<Teuchos::Array<std::string>>("regions").empty(),
                     path + ": \"regions\" is empty. Name each region of the fluid.");
      });
  return table;
}

FluidOptions fluid_options(const Teuchos::ParameterList& list) {
  FluidOptions options;
  options.regions = list.get<Teuchos::Array<std::string>>("regions").toVector();
  options.density = list.get<double>("density");
  options.viscosity = list.get<double>("viscosity");
  options.viscous_factor = list.get<double>("stabilisation viscous factor");
  const Teuchos::ParameterList& surfaces = list.sublist("Surfaces");
  for (auto it = surfaces.begin(); it != surfaces.end(); ++it)
    options.conditions.push_back(
        condition_of(surfaces.name(it), surfaces.sublist(surfaces.name(it))));
  return options;
}

std::vector<std::string> FluidOptions::interface_surfaces() const {
  std::vector<std::string> names;
  for (const FlowCondition& condition : conditions)
    if (condition.kind == "interface") names.push_back(condition.surface);
  return names;
}

}  // namespace tunica::problems
