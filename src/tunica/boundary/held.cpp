#include "tunica/boundary/held.hpp"

#include <Teuchos_Array.hpp>

#include "tunica/base/error.hpp"

namespace tunica::boundary {

using Names = Teuchos::Array<std::string>;

void check_components(const Teuchos::ParameterList& list, const std::string& path) {
  if (!list.isParameter("components")) return;  // another condition
  TUNICA_CHECK(!list.get<Names>("components").empty(),
               path + ": \"components\" is empty, expected x, y or z.");
  for (const auto& c : list.get<Names>("components"))
    TUNICA_CHECK(c == "x" || c == "y" || c == "z",
                 path + ": \"components\" holds \"" + c + "\", expected x, y or z.");
}

std::vector<int> components_of(const Teuchos::ParameterList& list) {
  std::vector<int> components;
  for (const auto& c : list.get<Names>("components")) components.push_back(c[0] - 'x');
  return components;
}

ConditionEntry clamped() {
  return {Field::wall, "clamped", params::Table("no displacement"),
          [](const Teuchos::ParameterList&, const fields::FieldMesh&, int) {
            return terms(std::make_unique<Held>(std::vector<int>{0, 1, 2}));
          }};
}

ConditionEntry held() {
  params::Table table;
  table.names("components", std::nullopt, "components without displacement, of x, y and z")
      .check(check_components);
  return {Field::wall, "held", table,
          [](const Teuchos::ParameterList& list, const fields::FieldMesh&, int) {
            return terms(std::make_unique<Held>(components_of(list)));
          }};
}

ConditionEntry loaded_by_fluid() {
  return {Field::wall, interface_condition, params::Table("loaded by the fluid"),
          [](const Teuchos::ParameterList&, const fields::FieldMesh&, int) { return Terms(); }};
}

}  // namespace tunica::boundary
