#include "tunica/observe/force_groups.hpp"

#include <Teuchos_Array.hpp>
#include <algorithm>
#include <map>

#include "tunica/base/error.hpp"

namespace tunica::observe {

namespace {

constexpr const char* list_name = "Force Groups";

Vec3 direction(const Teuchos::ParameterList& list, const std::string& key) {
  const auto& numbers = list.get<Teuchos::Array<double>>(key);
  const Vec3 v{numbers[0], numbers[1], numbers[2]};
  return 1.0 / norm(v) * v;
}

void check_group(const Teuchos::ParameterList& list, const std::string& path) {
  TUNICA_CHECK(!list.get<Teuchos::Array<std::string>>("surfaces").empty(),
               path + ": \"surfaces\" is empty, expected names of surfaces of the fluid.");
  for (const char* key : {"drag", "lift"}) {
    const auto& v = list.get<Teuchos::Array<double>>(key);
    TUNICA_CHECK(norm(Vec3{v[0], v[1], v[2]}) > 0.0,
                 path + ": \"" + key + "\" is {0, 0, 0}, expected a direction.");
  }
}

}  // namespace

void add_force_group_keys(params::Table& table) {
  params::Table group(
      "Surfaces whose forces are summed: pressure and friction of the fluid. They become the "
      "columns "
      "drag_NAME_mN and lift_NAME_mN of steps.csv.");
  group.names("surfaces", std::nullopt, "surfaces of the fluid, also those beside a wall")
      .numbers("drag", std::vector<double>{1.0, 0.0, 0.0}, params::any(), 3, "1",
               "direction of the first column, of any length")
      .numbers("lift", std::vector<double>{0.0, 1.0, 0.0}, params::any(), 3, "1",
               "direction of the second column")
      .number(
          "per length", 0.0, params::non_negative(), "mm",
          "the forces are divided by it, and the columns end with _mN_per_mm, which is N/m: the "
          "thickness of a slab of a plane flow; 0: they are not")
      .check(check_group);
  table.entries(list_name, group, "Forces on several surfaces together, by names of one's own.");
}

std::vector<ForceGroup> force_groups_in(const Teuchos::ParameterList& the_case) {
  std::vector<ForceGroup> groups;
  if (!the_case.isSublist("Output") || !the_case.sublist("Output").isSublist(list_name))
    return groups;
  const Teuchos::ParameterList& lists = the_case.sublist("Output").sublist(list_name);
  for (auto it = lists.begin(); it != lists.end(); ++it) {
    const Teuchos::ParameterList& list = lists.sublist(lists.name(it));
    groups.push_back({lists.name(it), list.get<Teuchos::Array<std::string>>("surfaces").toVector(),
                      direction(list, "drag"), direction(list, "lift"),
                      list.get<double>("per length")});
  }
  return groups;
}

std::vector<std::string> surfaces_of(const std::vector<ForceGroup>& groups) {
  std::vector<std::string> names;
  for (const ForceGroup& group : groups)
    for (const std::string& name : group.surfaces)
      if (std::find(names.begin(), names.end(), name) == names.end()) names.push_back(name);
  return names;
}

// F = Σ_s (F_p + F_μ)
discretisation::Observables summed_forces(const std::vector<ForceGroup>& groups,
                                          const discretisation::Observables& of_surfaces) {
  std::map<std::string, double> value;
  for (const auto& o : of_surfaces) value[o.name] = o.value;
  discretisation::Observables found;
  for (const ForceGroup& group : groups) {
    Vec3 force{};
    for (const std::string& surface : group.surfaces)
      for (const char* part : {"pressure_force_", "viscous_force_"})
        for (int i = 0; i < 3; ++i) force[i] += value.at(part + surface + "_" + "xyz"[i] + "_mN");
    const bool is_divided = group.per_length > 0.0;
    const double length = is_divided ? group.per_length : 1.0;
    const std::string end = group.name + (is_divided ? "_mN_per_mm" : "_mN");
    found.push_back({"drag_" + end, dot(force, group.drag) / length});
    found.push_back({"lift_" + end, dot(force, group.lift) / length});
  }
  return found;
}

}  // namespace tunica::observe
