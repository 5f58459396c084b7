#include "tunica/boundary/registry.hpp"

#include "tunica/base/error.hpp"
#include "tunica/boundary/flow_rate.hpp"
#include "tunica/boundary/follower_pressure.hpp"
#include "tunica/boundary/held.hpp"
#include "tunica/boundary/moved.hpp"
#include "tunica/boundary/prescribed_velocity.hpp"
#include "tunica/boundary/support.hpp"
#include "tunica/boundary/surface_data.hpp"
#include "tunica/boundary/traction.hpp"
#include "tunica/boundary/windkessel.hpp"

namespace tunica::boundary {

namespace {

std::vector<ConditionEntry>& conditions() {
  static std::vector<ConditionEntry> all = {
      open_traction(),           // "traction" of a fluid
      open_pressure(),           // "pressure" of a fluid
      windkessel_condition(),    // "windkessel"
      resistance_condition(),    // "resistance"
      velocity_condition(),      // "velocity"
      velocity_from_file(),      // "velocity from file"
      flow_rate_condition(),     // "flow rate"
      no_slip(),                 // "no slip"
      held_velocity(),           // "held" of a fluid
      moves_with_wall(),         // "interface" of a fluid
      clamped(),                 // "clamped"
      held(),                    // "held"
      moved(),                   // "moved"
      displacement_from_file(),  // "displacement from file"
      moves_as_one(),            // "moves as one"
      dead_traction(),           // "traction" of a wall
      follower_pressure(),       // "pressure" of a wall
      support_condition(),       // "support"
      loaded_by_fluid(),         // "interface" of a wall
  };
  return all;
}

std::vector<ConditionEntry> conditions_for(Field field) {
  std::vector<ConditionEntry> found;
  for (const ConditionEntry& entry : conditions())
    if (entry.field == field) found.push_back(entry);
  return found;
}

}  // namespace

void register_condition(ConditionEntry condition) {
  for (const ConditionEntry& known : conditions_for(condition.field))
    TUNICA_CHECK(known.name != condition.name,
                 "the condition \"" + condition.name + "\" is registered twice.");
  conditions().push_back(std::move(condition));
}

std::vector<ConditionEntry> fluid_conditions() { return conditions_for(Field::fluid); }
std::vector<ConditionEntry> wall_conditions() { return conditions_for(Field::wall); }

params::Table condition_table(const std::string& sentence,
                              const std::vector<ConditionEntry>& entries) {
  std::vector<params::Table::Case> cases;
  for (const ConditionEntry& entry : entries) cases.push_back({entry.name, entry.table});
  params::Table table(sentence);
  table.variant("condition", std::nullopt, cases, "condition on the surface")
      .text("surface", "",
            "surface of the mesh; empty: the one that the list is named after. It permits several "
            "conditions on one surface, such as a load and held components");
  return table;
}

std::vector<Condition> conditions_of(const Teuchos::ParameterList& surfaces) {
  std::vector<Condition> conditions;
  for (auto it = surfaces.begin(); it != surfaces.end(); ++it) {
    const Teuchos::ParameterList& list = surfaces.sublist(surfaces.name(it));
    const auto& surface = list.get<std::string>("surface");
    conditions.push_back({surface.empty() ? surfaces.name(it) : surface, list});
  }
  return conditions;
}

Drive Condition::drive(Field field) const {
  for (const ConditionEntry& entry : conditions())
    if (entry.field == field && entry.name == kind()) return entry.drive(list);
  return {};
}

std::vector<std::string> interface_surfaces(const std::vector<Condition>& conditions) {
  std::vector<std::string> names;
  for (const Condition& condition : conditions)
    if (condition.kind() == interface_condition) names.push_back(condition.surface);
  return names;
}

}  // namespace tunica::boundary
