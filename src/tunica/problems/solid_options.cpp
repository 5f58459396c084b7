#include "tunica/problems/solid_options.hpp"

#include <Teuchos_Array.hpp>

#include "tunica/base/error.hpp"
#include "tunica/linear/linear_solver.hpp"
#include "tunica/materials/registry.hpp"
#include "tunica/nonlinear/newton.hpp"
#include "tunica/problems/fibre_frames.hpp"

namespace tunica::problems {

namespace {

Layer layer_of(const std::string& region, const Teuchos::ParameterList& list) {
  Layer layer{region, list.get<std::string>("law"), {}, 0.0, list.get<double>("density")};
  for (const materials::LawEntry& law : materials::laws()) {
    if (law.name != layer.law) continue;
    for (const materials::Constant& c : law.constants)
      layer.constants.emplace_back(c.name, list.get<double>(c.name));
    layer.bulk_modulus = law.bulk_modulus
                             ? law.bulk_modulus({layer.constants.begin(), layer.constants.end()})
                             : list.get<double>("bulk modulus");
  }
  return layer;
}

template <class Visit>
void for_each_sublist(const Teuchos::ParameterList& list, Visit visit) {
  for (auto it = list.begin(); it != list.end(); ++it)
    visit(list.name(it), list.sublist(list.name(it)));
}

std::unique_ptr<materials::HyperelasticLaw> law_of(const Layer& layer) {
  return materials::make_law(layer.law, {layer.constants.begin(), layer.constants.end()});
}

params::Table layer_table() {
  std::vector<params::Table::Case> laws;
  for (const materials::LawEntry& law : materials::laws()) {
    params::Table table(law.sentence);
    for (const materials::Constant& c : law.constants)
      table.number(c.name, c.fallback, params::between(c.low, c.high), c.unit, c.sentence);
    if (!law.bulk_modulus)
      table.number("bulk modulus", 1e5, params::positive(), "kPa", "bulk modulus κ");
    laws.push_back({law.name, table});
  }
  params::Table table("One layer of the wall.");
  table.variant("law", laws.front().value, laws, "hyperelastic law")
      .number("density", 1.2, params::positive(), "mg/mm^3", "density of the unloaded wall")
      .check([](const Teuchos::ParameterList& list, const std::string& path) {
        try {
          law_of(layer_of("", list));
        } catch (const Error& error) {
          throw Error(path + ": " + error.what());
        }
      });
  return table;
}

params::Table condition_table() {
  params::Table clamped("no displacement"), interface("loaded by the fluid"), held, traction,
      pressure;
  held.names("components", std::nullopt, "components without displacement, of x, y and z")
      .check([](const Teuchos::ParameterList& list, const std::string& path) {
        TUNICA_CHECK(!list.get<Teuchos::Array<std::string>>("components").empty(),
                     path + ": \"components\" is empty, expected x, y or z.");
        for (const auto& c : list.get<Teuchos::Array<std::string>>("components"))
          TUNICA_CHECK(c == "x" || c == "y" || c == "z",
                       path + ": \"components\" holds \"" + c + "\", expected x, y or z.");
      });
  traction
      .numbers("traction", std::nullopt, params::any(), 3, "kPa",
               "dead load per undeformed area, its direction fixed")
      .sublist("Amplitude", stepping::time_function_table());
  pressure
      .number("pressure", std::nullopt, params::any(), "kPa",
              "pressure that follows the deformed surface")
      .sublist("Amplitude", stepping::time_function_table());
  params::Table table("One surface of the wall. Surfaces that are not listed are free.");
  table.variant("condition", std::nullopt,
                {{"clamped", clamped},
                 {"held", held},
                 {"traction", traction},
                 {"pressure", pressure},
                 {"interface", interface}},
                "what happens on the surface");
  return table;
}

WallCondition condition_of(const std::string& surface, const Teuchos::ParameterList& list) {
  WallCondition condition;
  condition.surface = surface;
  condition.kind = list.get<std::string>("condition");
  if (condition.kind == "clamped") condition.components = {0, 1, 2};
  if (condition.kind == "held")
    for (const auto& c : list.get<Teuchos::Array<std::string>>("components"))
      condition.components.push_back(c[0] - 'x');
  if (condition.kind == "traction") {
    const auto& t = list.get<Teuchos::Array<double>>("traction");
    condition.traction = {t[0], t[1], t[2]};
  }
  if (condition.kind == "pressure") condition.pressure = list.get<double>("pressure");
  if (list.isSublist("Amplitude"))
    condition.amplitude = stepping::TimeFunction(list.sublist("Amplitude"));
  return condition;
}

}  // namespace

params::Table solid_solver_table() {
  return linear::linear_solver_table(
      {"multigrid", linear::default_block_preconditioner(6, 2), multigrid::mixed_cycle_list(3)});
}

params::Table solid_table() {
  params::Table table("The wall: mixed displacement-pressure hyperelasticity, P1-P1 with PSPG.");
  table.entries("Layers", layer_table(), "one list for each region of the mesh that is wall")
      .sublist("Fibre Frame", fibre_frame_table())
      .entries("Surfaces", condition_table(), "one list for each surface with a condition")
      .choice("analysis", "dynamic", {"dynamic", "static"},
              "with inertia, or a sequence of equilibria")
      .sublist("Newmark", stepping::newmark_table())
      .choice("stabilisation", "inertial", {"inertial", "paper"},
              "PSPG parameter: 1/(4 mu/h^2 + rho/(beta dt^2)), or the paper's h^2/(4 mu), which "
              "ignores inertia")
      .number("stabilisation modulus factor", 1.0, params::positive(), "1",
              "multiplies the modulus mu of the PSPG parameter")
      .number("stabilisation at layers", 0.03, params::Range{0.0, 1.0, true, false}, "1",
              "multiplies the PSPG parameter of elements that touch another material, where the "
              "pressure jumps; 1 as in the paper")
      .sublist("Newton", nonlinear::newton_table())
      .sublist("Linear Solver", solid_solver_table())
      .check([](const Teuchos::ParameterList& list, const std::string& path) {
        TUNICA_CHECK(list.sublist("Layers").numParams() > 0,
                     path + " / Layers: no layer. Name each region of the wall.");
        if (list.sublist("Fibre Frame").get<std::string>("kind") != "none") return;
        for_each_sublist(list.sublist("Layers"), [&](const std::string& name, const auto& layer) {
          TUNICA_CHECK(!law_of(layer_of(name, layer))->has_fibres(),
                       path + " / Layers / " + name + ": the law \"" +
                           layer.template get<std::string>("law") + "\" has fibres, but " + path +
                           " / Fibre Frame has no directions for them. Set its \"kind\" to "
                           "\"tube\" or \"laplace\".");
        });
      });
  return table;
}

SolidOptions solid_options(const Teuchos::ParameterList& list) {
  SolidOptions options;
  for_each_sublist(list.sublist("Layers"), [&](const std::string& name, const auto& layer) {
    options.layers.push_back(layer_of(name, layer));
  });
  for_each_sublist(list.sublist("Surfaces"), [&](const std::string& name, const auto& surface) {
    options.conditions.push_back(condition_of(name, surface));
  });
  options.is_static = list.get<std::string>("analysis") == "static";
  options.beta = list.sublist("Newmark").get<double>("beta");
  options.gamma = list.sublist("Newmark").get<double>("gamma");
  options.has_inertia_in_tau = list.get<std::string>("stabilisation") == "inertial";
  options.modulus_factor = list.get<double>("stabilisation modulus factor");
  options.layer_factor = list.get<double>("stabilisation at layers");
  options.frame_surfaces = frame_surfaces(list.sublist("Fibre Frame"));
  return options;
}

std::vector<std::string> SolidOptions::regions() const {
  std::vector<std::string> names;
  for (const Layer& layer : layers) names.push_back(layer.region);
  return names;
}

std::vector<std::string> SolidOptions::interface_surfaces() const {
  std::vector<std::string> names;
  for (const WallCondition& condition : conditions)
    if (condition.kind == "interface") names.push_back(condition.surface);
  return names;
}

}  // namespace tunica::problems
