#include "tunica/setup/one_field.hpp"

#include <vector>

namespace tunica::setup {

namespace {

std::vector<std::string> lists_in(const Teuchos::ParameterList& list) {
  std::vector<std::string> names;
  for (auto it = list.begin(); it != list.end(); ++it)
    if (list.isSublist(list.name(it))) names.push_back(list.name(it));
  return names;
}

bool has_text(const Teuchos::ParameterList& list, const std::string& key, const std::string& part) {
  return list.isType<std::string>(key) &&
         list.get<std::string>(key).find(part) != std::string::npos;
}

/// Surfaces that fluid and wall share; a wall forgets them.
std::string part_from_interface(Teuchos::ParameterList& field, bool is_wall) {
  if (!field.isSublist("Surfaces")) return "";
  Teuchos::ParameterList& surfaces = field.sublist("Surfaces");
  std::string parted;
  for (const std::string& name : lists_in(surfaces)) {
    if (!has_text(surfaces.sublist(name), "condition", "interface")) continue;
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
    for (const std::string& name : lists_in(list.sublist("Probes"))) {
      const bool is_of_fluid = has_text(list.sublist("Probes").sublist(name), "quantity", "fluid");
      if (is_of_fluid == is_wall) list.sublist("Probes").remove(name);
    }
  if (is_wall && list.isSublist("Output")) list.sublist("Output").remove("averages from", false);
  const std::string parted = part_from_interface(list.sublist(is_wall ? "Wall" : "Fluid"), is_wall);
  return program + " ignores " + gone + " of this case and solves the " +
         (is_wall ? "wall alone, free on " : "fluid alone, in rigid walls on ") +
         (parted.empty() ? "all of its surface" : parted) + ". tunica-fsi couples both.";
}

}  // namespace tunica::setup
