#include "tunica/observe/field_kinds.hpp"

#include "tunica/base/error.hpp"

namespace tunica::observe {

namespace {

std::vector<FieldKind>& all_kinds() {
  static std::vector<FieldKind> of_process;
  return of_process;
}

}  // namespace

void register_field_kind(FieldKind kind) {
  TUNICA_CHECK(kind.region == "fluid" || kind.region == "wall", "the kind of field \"" + kind.name +
                                                                    "\" lives on \"" + kind.region +
                                                                    "\", expected fluid or wall.");
  for (const FieldKind& known : field_kinds())
    TUNICA_CHECK(known.name != kind.name,
                 "the kind of field \"" + kind.name + "\" is registered twice.");
  all_kinds().push_back(std::move(kind));
}

const std::vector<FieldKind>& field_kinds() { return all_kinds(); }

const FieldKind& kind_of(const Teuchos::ParameterList& entry) {
  const auto& name = entry.get<std::string>("kind");
  for (const FieldKind& kind : field_kinds())
    if (kind.name == name) return kind;
  throw Error("no kind of field is called \"" + name + "\"");
}

void add_field_entries(bool has_fluid, bool has_wall, params::Table& table) {
  std::vector<params::Table::Case> kinds;
  for (const FieldKind& kind : field_kinds())
    if (kind.lives_in(has_fluid, has_wall)) kinds.push_back({kind.name, kind.table});
  if (kinds.empty()) return;
  params::Table entry("A field that is solved in each step after the others.");
  entry.variant("kind", std::nullopt, kinds, "kind of the field");
  table.entries("Fields", entry, "fields beside fluid and wall");
}

}  // namespace tunica::observe
