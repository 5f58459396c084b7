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

namespace {

ConditionEntry held_in(Field field, const std::string& sentence) {
  params::Table table;
  table.names("components", std::nullopt, sentence).check(check_components);
  return {field, "held", table,
          [](const Teuchos::ParameterList& list, const fields::FieldMesh&, int) {
            return terms(std::make_unique<Held>(components_of(list)));
          }};
}

}  // namespace

ConditionEntry held() {
  return held_in(Field::wall, "components without displacement, of x, y and z");
}

ConditionEntry held_velocity() {
  return held_in(Field::fluid,
                 "components without velocity, of x, y and z; the one along the normal on a plane "
                 "of symmetry");
}

ConditionEntry loaded_by_fluid() {
  return {Field::wall, interface_condition, params::Table("loaded by the fluid"),
          [](const Teuchos::ParameterList&, const fields::FieldMesh&, int) { return Terms(); }};
}

}  // namespace tunica::boundary
