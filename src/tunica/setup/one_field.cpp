#include "tunica/setup/one_field.hpp"

#include <vector>

#include "tunica/observe/field_kinds.hpp"
#include "tunica/observe/probes.hpp"

namespace tunica::setup {

namespace {

std::vector<std::string> lists_in(const Teuchos::ParameterList& list) {
  std::vector<std::string> names;
  for (auto it = list.begin(); it != list.end(); ++it)
    if (list.isSublist(list.name(it))) names.push_back(list.name(it));
  return names;
}

/// Of the condition between fluid and wall, which the case, not yet resolved, may leave out.
bool is_interface(const Teuchos::ParameterList& surface) {
  return surface.isType<std::string>("condition") &&
         surface.get<std::string>("condition") == "interface";
}

/// The region that the fields of a kind live on; empty for one that nobody knows.
std::string region_of(const Teuchos::ParameterList& entry) {
  for (const observe::FieldKind& kind : observe::field_kinds())
    if (entry.isType<std::string>("kind") && entry.get<std::string>("kind") == kind.name)
      return kind.region;
  return "";
}

/// True where a probe may stay with this region: what no field has is an error that its check
/// tells.
bool asks_of(const Teuchos::ParameterList& probe, const std::string& region) {
  if (!probe.isType<std::string>("quantity")) return true;
  const std::string found = observe::region_of_quantity(probe.get<std::string>("quantity"));
  return found.empty() || found == region;
}

/// Surfaces that fluid and wall share; a wall forgets them.
std::string part_from_interface(Teuchos::ParameterList& field, bool is_wall) {
  if (!field.isSublist("Surfaces")) return "";
  Teuchos::ParameterList& surfaces = field.sublist("Surfaces");
  std::string parted;
  for (const std::string& name : lists_in(surfaces)) {
    if (!is_interface(surfaces.sublist(name))) continue;
    parted += (parted.empty() ? "" : ", ") + name;
    if (is_wall)
      surfaces.remove(name);
    else
      surfaces.sublist(name).set<std::string>("condition", "no slip");
  }
  return parted;
}

}  // namespace

std::string leave_one_field(Teuchos::ParameterList& list, const std::string& program) {
  const bool is_wall = program == "tunica-solid";
  if (!is_wall && program != "tunica-fluid") return "";
  if (!list.isSublist("Fluid") || !list.isSublist("Wall")) return "";
  std::string gone;
  for (const std::string name : {is_wall ? "Fluid" : "Wall", "Mesh Motion", "Coupling"})
    if (list.isSublist(name)) {
      list.remove(name);
      gone += (gone.empty() ? "" : ", ") + name;
    }
  if (list.isSublist("Probes"))
    for (const std::string& name : lists_in(list.sublist("Probes")))
      if (!asks_of(list.sublist("Probes").sublist(name), is_wall ? "wall" : "fluid"))
        list.sublist("Probes").remove(name);
  if (list.isSublist("Fields"))
    for (const std::string& name : lists_in(list.sublist("Fields")))
      if (region_of(list.sublist("Fields").sublist(name)) == (is_wall ? "fluid" : "wall"))
        list.sublist("Fields").remove(name);
  if (is_wall && list.isSublist("Output")) list.sublist("Output").remove("averages from", false);
  const std::string parted = part_from_interface(list.sublist(is_wall ? "Wall" : "Fluid"), is_wall);
  return program + " ignores " + gone + " of this case and solves the " +
         (is_wall ? "wall alone, free on " : "fluid alone, in rigid walls on ") +
         (parted.empty() ? "all of its surface" : parted) + ". tunica-fsi couples both.";
}

}  // namespace tunica::setup
