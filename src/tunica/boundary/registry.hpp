#pragma once
#include <string>
#include <vector>

#include "tunica/boundary/condition.hpp"

namespace tunica::boundary {

/// The conditions of a fluid, and those of a wall.
std::vector<ConditionEntry> fluid_conditions();
std::vector<ConditionEntry> wall_conditions();

/// Adds a condition, before the schema of a case is asked for. Throws Error where its field has one
/// of that name.
void register_condition(ConditionEntry condition);

/// One condition of a case on one surface; a surface may have several.
struct Condition {
  std::string surface;
  Teuchos::ParameterList list;  ///< resolved

  std::string kind() const { return list.get<std::string>("condition"); }
  Drive drive(Field field) const;
};

/// The keys of the list of one surface.
params::Table condition_table(const std::string& sentence,
                              const std::vector<ConditionEntry>& entries);
/// All conditions of a resolved "Surfaces" list.
std::vector<Condition> conditions_of(const Teuchos::ParameterList& surfaces);
std::vector<std::string> interface_surfaces(const std::vector<Condition>& conditions);

}  // namespace tunica::boundary
