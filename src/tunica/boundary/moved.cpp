#include "tunica/boundary/moved.hpp"

#include <Teuchos_Array.hpp>

#include "tunica/boundary/held.hpp"

namespace tunica::boundary {

namespace {

ConditionEntry entry_of(const std::string& name, params::Table table, bool has_force) {
  table.sublist("Amplitude", stepping::time_function_table());
  return {
      Field::wall, name, table,
      [has_force](const Teuchos::ParameterList& list, const fields::FieldMesh&, int) {
        return terms(std::make_unique<Moved>(list, has_force));
      },
      [has_force](const Teuchos::ParameterList& list) {
        return Drive{Drive::Kind::motion, length_of(list, has_force ? "force" : "displacement")};
      }};
}

params::Table table_of(const std::string& sentence) {
  params::Table table(sentence);
  table
      .names("components", std::vector<std::string>{"x", "y", "z"},
             "components in which it moves as one, of x, y and z; in the others it is free")
      .check(check_components);
  return table;
}

}  // namespace

Moved::Moved(const Teuchos::ParameterList& list, bool has_force)
    : components_(components_of(list)), has_force_(has_force),
      amplitude_(list.sublist("Amplitude")) {
  const auto& value = list.get<Teuchos::Array<double>>(has_force ? "force" : "displacement");
  value_ = {value[0], value[1], value[2]};
}

std::vector<CommonMotion> Moved::common_motions() const {
  std::vector<CommonMotion> motions;
  for (const int i : components_)
    motions.push_back(
        {i, has_force_, [this, i](double time) { return amplitude_(time) * value_[i]; }});
  return motions;
}

ConditionEntry moved() {
  params::Table table = table_of("displaced as one");
  table.numbers("displacement", std::nullopt, params::any(), 3, "mm",
                "displacement; its components that are not named in \"components\" are ignored");
  return entry_of("moved", table, false);
}

ConditionEntry moves_as_one() {
  params::Table table = table_of("moves as one, driven by the forces on it");
  table.numbers("force", std::vector<double>{0.0, 0.0, 0.0}, params::any(), 3, "mN",
                "force on the whole surface, in addition to other loads on it");
  return entry_of("moves as one", table, true);
}

}  // namespace tunica::boundary
