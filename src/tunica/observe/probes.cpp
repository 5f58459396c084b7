#include "tunica/observe/probes.hpp"

#include <Teuchos_Array.hpp>
#include <algorithm>
#include <sstream>

#include "tunica/base/error.hpp"
#include "tunica/base/reduce.hpp"
#include "tunica/observe/field_kinds.hpp"
#include "tunica/observe/fluid_field.hpp"
#include "tunica/observe/wall_field.hpp"

namespace tunica::observe {

namespace {

/// A probe may lie outside the mesh by no more than this part of the nearest element's edge. It is
/// then moved to the surface.
constexpr double tolerance = 1e-3;

std::string braces(const Vec3& x) {
  std::ostringstream text;
  text << "{" << x[0] << ", " << x[1] << ", " << x[2] << "}";
  return text.str();
}

void check_place(const fields::Place& place, const Vec3& position, const std::string& name,
                 const std::string& field) {
  std::ostringstream text;
  text << "Probes / " << name << ": \"position\" " << braces(position) << " lies " << place.distance
       << " mm outside the undeformed " << field << ". The nearest point in it is "
       << braces(place.position) << ".";
  TUNICA_CHECK(place.distance <= tolerance * place.element_length, text.str());
}

const Quantity* find(const std::vector<Quantity>& all, const std::string& name) {
  const auto found = std::find_if(all.begin(), all.end(),
                                  [&](const Quantity& quantity) { return quantity.name == name; });
  return found == all.end() ? nullptr : &*found;
}

/// Whose quantity it is, and on which mesh that field lives.
struct Target {
  std::string field, region;
  Quantity quantity;
};

Target target_of(const Teuchos::ParameterList& the_case, const std::string& probe) {
  const Teuchos::ParameterList& entry = the_case.sublist("Probes").sublist(probe);
  const auto& name = entry.get<std::string>("quantity");
  const std::vector<Quantity> of_fluid = fluid_quantities(), of_wall = wall_quantities();
  if (const Quantity* known = find(of_fluid, name)) return {"fluid", "fluid", *known};
  if (const Quantity* known = find(of_wall, name)) return {"wall", "wall", *known};
  const auto& field = entry.get<std::string>("field");
  const std::string where = "Probes / " + probe + ": ";
  TUNICA_CHECK(the_case.isSublist("Fields") && the_case.sublist("Fields").isSublist(field),
               where + "\"quantity\" is \"" + name + "\", of a field in the list Fields, but \"" +
                   field + "\" is none of them. Give its name as \"field\".");
  const FieldKind& kind = kind_of(the_case.sublist("Fields").sublist(field));
  const Quantity* known = find(kind.quantities, name);
  TUNICA_CHECK(known != nullptr,
               where + "a field of the kind \"" + kind.name + "\" has no \"" + name + "\".");
  return {field, kind.region, *known};
}

}  // namespace

std::string region_of_quantity(const std::string& name) {
  if (find(fluid_quantities(), name) != nullptr) return "fluid";
  if (find(wall_quantities(), name) != nullptr) return "wall";
  for (const FieldKind& kind : field_kinds())
    if (find(kind.quantities, name) != nullptr) return kind.region;
  return "";
}

params::Table probe_table(bool has_fluid, bool has_wall) {
  std::vector<std::string> names;
  const auto add = [&names](const std::vector<Quantity>& quantities) {
    for (const Quantity& quantity : quantities) names.push_back(quantity.name);
  };
  if (has_fluid) add(fluid_quantities());
  if (has_wall) add(wall_quantities());
  const std::size_t n_own = names.size();
  for (const FieldKind& kind : field_kinds())
    if (kind.lives_in(has_fluid, has_wall)) add(kind.quantities);
  params::Table table("A point whose value becomes a column of steps.csv.");
  table
      .choice(
          "quantity", std::nullopt, names,
          "fluid pressure [kPa], length of the wall's displacement, change of the distance from "
          "the z axis [mm], or a component of the fluid's velocity [mm/ms] or of the wall's "
          "displacement [mm]")
      .numbers("position", std::nullopt, params::any(), 3, "mm",
               "point in the undeformed field at which the value is interpolated");
  if (names.size() > n_own)
    table.text(
        "field", "",
        "name of a field in the list Fields, for a quantity that fluid and wall do not have");
  return table;
}

Probes::Probes(const Teuchos::ParameterList& the_case,
               const std::map<std::string, fields::FieldMesh>& meshes) {
  const Teuchos::ParameterList& list = the_case.sublist("Probes");
  for (auto it = list.begin(); it != list.end(); ++it) {
    const std::string& name = list.name(it);
    const auto& x = list.sublist(name).get<Teuchos::Array<double>>("position");
    const Vec3 position{x[0], x[1], x[2]};
    const Target target = target_of(the_case, name);
    const fields::Place place = fields::locate(meshes.at(target.region), position);
    check_place(place, position, name, target.region);
    probes_.push_back({name, target.field, target.quantity, place});
  }
}

discretisation::Observables Probes::observe(
    const std::vector<std::unique_ptr<Field>>& fields) const {
  if (probes_.empty()) return {};
  std::map<std::string, Sampler> samplers;
  for (const auto& field : fields)
    if (std::any_of(probes_.begin(), probes_.end(),
                    [&](const Probe& probe) { return probe.field == field->name(); }))
      samplers[field->name()] = field->sampler();
  discretisation::Observables found;
  for (const Probe& probe : probes_) {
    std::string column = probe.quantity.name + "_" + probe.name + "_" + probe.quantity.unit;
    for (char& c : column)
      if (c == ' ') c = '_';
    const double value =
        probe.place.is_here ? samplers.at(probe.field)(probe.quantity.name, probe.place) : 0.0;
    found.push_back({column, global_sum(*fields.front()->mesh().comm, value)});
  }
  return found;
}

}  // namespace tunica::observe
