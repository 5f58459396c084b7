#pragma once
#include <functional>
#include <string>
#include <vector>

#include "tunica/boundary/boundary_term.hpp"
#include "tunica/params/table.hpp"

namespace tunica::boundary {

/// A condition that a list of a surface can name.
struct ConditionEntry {
  using Make = std::function<Terms(const Teuchos::ParameterList& list,
                                   const fields::FieldMesh& mesh, int surface)>;

  std::string name;
  params::Table table;  ///< its keys
  Make make;            ///< its terms, in the order in which they are added. Collective.
};

/// Those of a fluid and of a wall; each is one line.
const std::vector<ConditionEntry>& fluid_conditions();
const std::vector<ConditionEntry>& wall_conditions();

/// The condition that couples fluid and wall; it stands in both registries.
constexpr const char* interface_condition = "interface";

/// What a case says of one surface.
struct Condition {
  std::string surface;
  Teuchos::ParameterList list;  ///< resolved

  std::string kind() const { return list.get<std::string>("condition"); }
};

/// The keys of the list of one surface.
params::Table condition_table(const std::string& sentence,
                              const std::vector<ConditionEntry>& entries);
/// All conditions of a resolved "Surfaces" list.
std::vector<Condition> conditions_of(const Teuchos::ParameterList& surfaces);
std::vector<std::string> interface_surfaces(const std::vector<Condition>& conditions);

}  // namespace tunica::boundary
