#include "tunica/boundary/registry.hpp"

#include <Teuchos_Array.hpp>
#include <algorithm>

#include "tunica/base/error.hpp"
#include "tunica/boundary/backflow.hpp"
#include "tunica/boundary/follower_pressure.hpp"
#include "tunica/boundary/held.hpp"
#include "tunica/boundary/prescribed_velocity.hpp"
#include "tunica/boundary/traction.hpp"

namespace tunica::boundary {

namespace {

using List = Teuchos::ParameterList;
using fields::FieldMesh;

params::Table with_amplitude(params::Table table) {
  return table.sublist("Amplitude", stepping::time_function_table());
}

params::Table traction_table(const std::string& sentence) {
  params::Table table;
  return table.numbers("traction", std::nullopt, params::any(), 3, "kPa", sentence);
}

params::Table pressure_table(const std::string& sentence) {
  params::Table table;
  return table.number("pressure", std::nullopt, params::any(), "kPa", sentence);
}

/// Of a surface that the fluid may pass.
params::Table open_table(params::Table table) {
  add_backflow_key(table);
  return with_amplitude(table);
}

params::Table velocity_table() {
  params::Table table;
  table
      .numbers("velocity", std::nullopt, params::any(), 3, "mm/ms",
               "velocity, at the centre if the profile is parabolic")
      .choice("profile", "uniform", {"uniform", "parabolic"},
              "the same everywhere, or parabolic with zero at the rim of a round surface");
  return with_amplitude(table);
}

params::Table held_table() {
  params::Table table;
  table.names("components", std::nullopt, "components without displacement, of x, y and z")
      .check([](const List& list, const std::string& path) {
        if (!list.isParameter("components")) return;  // another condition
        TUNICA_CHECK(!list.get<Teuchos::Array<std::string>>("components").empty(),
                     path + ": \"components\" is empty, expected x, y or z.");
        for (const auto& c : list.get<Teuchos::Array<std::string>>("components"))
          TUNICA_CHECK(c == "x" || c == "y" || c == "z",
                       path + ": \"components\" holds \"" + c + "\", expected x, y or z.");
      });
  return table;
}

template <class... Term>
Terms terms(std::unique_ptr<Term>... each) {
  Terms all;
  (all.push_back(std::move(each)), ...);
  return all;
}

/// A load on a surface that the fluid may pass.
Terms open_surface(const List& list, const FieldMesh&, int) {
  Terms all = terms(std::make_unique<Traction>(list, false));
  const double beta = list.get<double>("backflow stabilisation");
  if (beta != 0.0) all.push_back(std::make_unique<Backflow>(beta));
  return all;
}

Terms velocity(const List& list, const FieldMesh& mesh, int surface) {
  return terms(std::make_unique<PrescribedVelocity>(list, mesh, surface));
}

Terms no_slip(const List&, const FieldMesh&, int) { return terms(std::make_unique<NoSlip>()); }

Terms moves_with_wall(const List&, const FieldMesh&, int) {
  return terms(std::make_unique<InterfaceVelocity>());
}

Terms dead_load(const List& list, const FieldMesh&, int) {
  return terms(std::make_unique<Traction>(list, true));
}

Terms follower_pressure(const List& list, const FieldMesh&, int) {
  return terms(std::make_unique<FollowerPressure>(list));
}

Terms clamped(const List&, const FieldMesh&, int) {
  return terms(std::make_unique<Held>(std::vector<int>{0, 1, 2}));
}

Terms held(const List& list, const FieldMesh&, int) {
  std::vector<int> components;
  for (const auto& c : list.get<Teuchos::Array<std::string>>("components"))
    components.push_back(c[0] - 'x');
  return terms(std::make_unique<Held>(components));
}

/// The fluid's force comes from outside.
Terms loaded_by_fluid(const List&, const FieldMesh&, int) { return {}; }

}  // namespace

// clang-format off: one line each
const std::vector<ConditionEntry>& fluid_conditions() {
  static const std::vector<ConditionEntry> all{
      {"traction", open_table(traction_table("σ n on the surface; zeros let the fluid out freely")),
       open_surface},
      {"pressure", open_table(pressure_table("p of the traction -p n")), open_surface},
      {"velocity", velocity_table(), velocity},
      {"no slip", params::Table("no velocity"), no_slip},
      {interface_condition, params::Table("moves with the wall"), moves_with_wall},
  };
  return all;
}

const std::vector<ConditionEntry>& wall_conditions() {
  static const std::vector<ConditionEntry> all{
      {"clamped", params::Table("no displacement"), clamped},
      {"held", held_table(), held},
      {"traction",
       with_amplitude(traction_table("dead load per undeformed area, its direction fixed")),
       dead_load},
      {"pressure", with_amplitude(pressure_table("pressure that follows the deformed surface")),
       follower_pressure},
      {interface_condition, params::Table("loaded by the fluid"), loaded_by_fluid},
  };
  return all;
}
// clang-format on

params::Table condition_table(const std::string& sentence,
                              const std::vector<ConditionEntry>& entries) {
  std::vector<params::Table::Case> cases;
  for (const ConditionEntry& entry : entries) cases.push_back({entry.name, entry.table});
  params::Table table(sentence);
  table.variant("condition", std::nullopt, cases, "what happens on the surface");
  return table;
}

std::vector<Condition> conditions_of(const Teuchos::ParameterList& surfaces) {
  std::vector<Condition> conditions;
  for (auto it = surfaces.begin(); it != surfaces.end(); ++it)
    conditions.push_back({surfaces.name(it), surfaces.sublist(surfaces.name(it))});
  return conditions;
}

std::vector<std::string> interface_surfaces(const std::vector<Condition>& conditions) {
  std::vector<std::string> names;
  for (const Condition& condition : conditions)
    if (condition.kind() == interface_condition) names.push_back(condition.surface);
  return names;
}

}  // namespace tunica::boundary
