#include "tunica/stepping/registry.hpp"

#include <algorithm>

#include "tunica/stepping/bdf2.hpp"
#include "tunica/stepping/implicit_euler.hpp"
#include "tunica/stepping/newmark.hpp"
#include "tunica/stepping/statics.hpp"
#include "tunica/stepping/trapezoidal.hpp"

namespace tunica::stepping {

const std::vector<SchemeEntry>& schemes() {
  static const std::vector<SchemeEntry> all = {
      bdf2_scheme(),            // "bdf2"
      implicit_euler_scheme(),  // "implicit euler"
      newmark_scheme(),         // "newmark"
      trapezoidal_scheme(),     // "trapezoidal"
  };
  return all;
}

namespace {

/// Adds the key, and the lists of the schemes that have one.
void add_keys(params::Table& table, bool is_fluid, const std::string& what) {
  std::vector<std::string> names;
  std::string sentence = what;
  for (const SchemeEntry& entry : schemes()) {
    if (is_fluid && !entry.is_for_fluids) continue;
    sentence += (names.empty() ? ": " : "; ") + entry.name + ", " + entry.sentence;
    names.push_back(entry.name);
  }
  table.choice("time scheme", names.front(), names, sentence);
  for (const SchemeEntry& entry : schemes())
    if (!entry.list.empty() && (!is_fluid || entry.is_for_fluids))
      table.sublist(entry.list, entry.table);
}

std::unique_ptr<TimeScheme> make_scheme(const Teuchos::ParameterList& field, int order) {
  const auto& name = field.get<std::string>("time scheme");
  const auto found = std::find_if(schemes().begin(), schemes().end(),
                                  [&](const SchemeEntry& entry) { return entry.name == name; });
  return found->make(field, order);
}

}  // namespace

void add_wall_scheme_keys(params::Table& table) {
  add_keys(table, false, "time scheme of a dynamic wall");
}

std::unique_ptr<TimeScheme> make_wall_scheme(const Teuchos::ParameterList& wall) {
  if (wall.get<std::string>("analysis") == "static") return std::make_unique<Statics>();
  return make_scheme(wall, 2);
}

void add_fluid_scheme_keys(params::Table& table) {
  add_keys(table, true, "time scheme of the fluid, its mesh and the interface");
}

std::unique_ptr<TimeScheme> make_fluid_scheme(const Teuchos::ParameterList& fluid) {
  return make_scheme(fluid, 1);
}

}  // namespace tunica::stepping
