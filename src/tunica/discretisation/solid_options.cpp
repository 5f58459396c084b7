#include "tunica/discretisation/solid_options.hpp"

#include <Teuchos_Array.hpp>
#include <algorithm>

#include "tunica/base/error.hpp"
#include "tunica/boundary/registry.hpp"
#include "tunica/discretisation/law_keys.hpp"
#include "tunica/materials/viscoelastic.hpp"
#include "tunica/stepping/registry.hpp"
#include "tunica/stepping/statics.hpp"

namespace tunica::discretisation {

// S' = S_e + Q: the law gives S_e, in equilibrium, and a Maxwell element beside it Q.
std::unique_ptr<materials::WallLaw> law_of(const Layer& layer) {
  std::unique_ptr<materials::WallLaw> law = materials::make_law(layer.law, layer.constants);
  if (layer.viscous_fraction > 0.0)
    law = std::make_unique<materials::Viscoelastic>(std::move(law), layer.viscous_fraction,
                                                    layer.relaxation_time);
  return law;
}

namespace {

Layer layer_of(const std::string& region, const Teuchos::ParameterList& list) {
  Layer layer{region, list.get<std::string>("law"), {}, 0.0, list.get<double>("density")};
  for (const materials::LawEntry& law : materials::laws()) {
    if (law.name != layer.law) continue;
    layer.constants = constants_in(list, law.constants);
    // Constants of some laws imply κ; beside others it is a key.
    layer.bulk_modulus =
        law.bulk_modulus ? law.bulk_modulus(layer.constants) : list.get<double>("bulk modulus");
  }
  layer.viscous_fraction = list.get<double>("viscous fraction");
  layer.relaxation_time = list.get<double>("relaxation time");
  return layer;
}

template <class Visit>
void for_each_sublist(const Teuchos::ParameterList& list, Visit visit) {
  for (auto it = list.begin(); it != list.end(); ++it)
    visit(list.name(it), list.sublist(list.name(it)));
}

params::Table layer_table() {
  std::vector<params::Table::Case> laws;
  for (const materials::LawEntry& law : materials::laws()) {
    params::Table table(law.sentence);
    add_constant_keys(law.constants, table);
    if (!law.bulk_modulus)
      table.number("bulk modulus", 1e5, params::positive(), "kPa", "bulk modulus κ");
    laws.push_back({law.name, table});
  }
  params::Table table("One layer of the wall.");
  table.variant("law", laws.front().value, laws, "hyperelastic law")
      .number("density", 1.2, params::positive(), "mg/mm^3", "density of the unloaded wall")
      .number("viscous fraction", 0.0, params::non_negative(), "1",
              "additional stress after a sudden stretch, as a part of the elastic stress, which "
              "then relaxes; 0: the wall is elastic, arteries have about 0.1 to 0.3")
      .number("relaxation time", 100.0, params::positive(), "ms",
              "time in which the additional stress decays to 1/e; ignored without it")
      .check([](const Teuchos::ParameterList& list, const std::string& path) {
        try {
          law_of(layer_of("", list));
        } catch (const Error& error) {
          throw Error(path + ": " + error.what());
        }
      });
  return table;
}

void add_stabilisation_keys(params::Table& table) {
  params::Table continuous;
  continuous.number("stabilisation at layers", 0.03, params::Range{0.0, 1.0, true, false}, "1",
                    "factor of the PSPG parameter of elements that touch another material, where "
                    "PSPG mistakes the pressure jump for a gradient; 1 as in the paper");
  table
      .choice("stabilisation", "dynamic", {"dynamic", "inertial", "paper"},
              "subscales of PSPG: time-dependent, which keep the pressure stable as the time step "
              "shrinks (dynamic); quasi-static, with inertia in the parameter 1/(4 mu/h^2 + "
              "rho/(beta dt^2)) only (inertial); or with the paper's parameter h^2/(4 mu), which "
              "ignores inertia (paper)")
      .choice("stabilisation residual", "automatic", {"automatic", "linear", "stress"},
              "residual that drives the subscales: without the divergence of the stress, as on "
              "linear elements, which makes the pressure too flat at surfaces (linear); or with "
              "it, recovered from the elements around each vertex (stress). The recovered stress "
              "is that of the previous step; in statics each step is solved again until the stress "
              "is its own. Not with a Prestress; automatic: stress in statics without a Prestress "
              "and with doubled pressures at layers, otherwise linear")
      .number("stabilisation modulus factor", 1.0, params::positive(), "1",
              "factor of the modulus mu in the PSPG parameter")
      .variant("pressure at layers", "doubled",
               {{"doubled", params::Table()}, {"continuous", continuous}},
               "pressures at vertices between layers of different material, where the pressure "
               "jumps: one for each material (doubled), or a single one as in the paper, of first "
               "order (continuous)")
      .number("volumetric stabilisation", 0.0, params::non_negative(), "1",
              "stiffness of a pressure of each element against its own change of volume, relative "
              "to the modulus mu. Large deformations under pressures of the order of mu or more "
              "need about 1; with much more the elements lock. 0: none, but 1 with a Prestress");
}

}  // namespace

void add_layer_keys(params::Table& table) {
  table.entries("Layers", layer_table(), "one list for each region of the mesh that is wall");
}

void add_solid_keys(params::Table& table) {
  table
      .entries("Surfaces",
               boundary::condition_table(
                   "One surface of the wall. Surfaces that are not listed are free.",
                   boundary::wall_conditions()),
               "one list for each surface with a condition")
      .choice("analysis", "dynamic", {"dynamic", "static"},
              "with inertia, or a sequence of equilibria");
  stepping::add_wall_scheme_keys(table);
  table.numbers("body force", std::vector<double>{0.0, 0.0, 0.0}, params::any(), 3, "mm/ms^2",
                "force per mass that acts on all of the wall, such as gravity, 9.81e-3, or what is "
                "left of it where a fluid at rest carries the rest");
  add_stabilisation_keys(table);
}

SolidOptions solid_options(const Teuchos::ParameterList& list) {
  SolidOptions options;
  for_each_sublist(list.sublist("Layers"), [&](const std::string& name, const auto& layer) {
    options.layers.push_back(layer_of(name, layer));
  });
  const auto& stabilisation = list.get<std::string>("stabilisation");
  // In statics there is no inertia that subscales could have.
  options.has_dynamic_subscales =
      stabilisation == "dynamic" && list.get<std::string>("analysis") == "dynamic";
  options.has_inertia_in_tau = stabilisation != "paper";
  options.is_static = list.get<std::string>("analysis") == "static";
  options.modulus_factor = list.get<double>("stabilisation modulus factor");
  options.has_doubled_pressure = list.get<std::string>("pressure at layers") == "doubled";
  options.layer_factor =
      options.has_doubled_pressure ? 1.0 : list.get<double>("stabilisation at layers");
  const auto& force = list.get<Teuchos::Array<double>>("body force");
  options.body_force = {force[0], force[1], force[2]};
  options.has_prestress = list.sublist("Prestress").get<double>("pressure") != 0.0;
  // Between materials σ' jumps: where the pressure does not, ∇p cannot follow.
  const auto& residual = list.get<std::string>("stabilisation residual");
  const bool is_suited =
      options.is_static && !options.has_prestress && options.has_doubled_pressure;
  options.has_stress_residual = residual == "stress" || (residual == "automatic" && is_suited);
  options.volumetric_factor = list.get<double>("volumetric stabilisation");
  // Prestretches need not fit together, so that nothing else keeps single elements from swelling,
  // which softens them: walls with fibres then bear no more than a part of their load.
  if (options.volumetric_factor == 0.0 && options.has_prestress) options.volumetric_factor = 1.0;
  options.conditions = boundary::conditions_of(list.sublist("Surfaces"));
  options.make_scheme = [list] { return stepping::make_wall_scheme(list); };
  return options;
}

SolidOptions in_statics(SolidOptions options) {
  options.is_static = true;
  options.has_dynamic_subscales = false;
  options.make_scheme = [] { return std::make_unique<stepping::Statics>(); };
  return options;
}

bool has_fibres(const SolidOptions& options) {
  return std::any_of(options.layers.begin(), options.layers.end(),
                     [](const Layer& layer) { return law_of(layer)->has_fibres(); });
}

std::vector<std::string> SolidOptions::regions() const {
  std::vector<std::string> names;
  for (const Layer& layer : layers) names.push_back(layer.region);
  return names;
}

}  // namespace tunica::discretisation
