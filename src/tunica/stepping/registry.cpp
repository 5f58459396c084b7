#include "tunica/stepping/registry.hpp"

#include <algorithm>

#include "tunica/stepping/implicit_euler.hpp"
#include "tunica/stepping/newmark.hpp"
#include "tunica/stepping/statics.hpp"

namespace tunica::stepping {

const std::vector<SchemeEntry>& schemes() {
  static const std::vector<SchemeEntry> all = {
      newmark_scheme(),         // "newmark"
      implicit_euler_scheme(),  // "implicit euler"
  };
  return all;
}

void add_scheme_keys(params::Table& table) {
  std::vector<std::string> names;
  for (const SchemeEntry& entry : schemes()) names.push_back(entry.name);
  table.choice("time scheme", names.front(), names,
               "of a dynamic wall: Newmark's, with the keys below, or implicit Euler, which gives "
               "the wall the velocity that it has on the interface");
  for (const SchemeEntry& entry : schemes())
    if (!entry.list.empty()) table.sublist(entry.list, entry.table);
}

std::unique_ptr<TimeScheme> make_scheme(const Teuchos::ParameterList& wall) {
  if (wall.get<std::string>("analysis") == "static") return std::make_unique<Statics>();
  const auto& name = wall.get<std::string>("time scheme");
  const auto found = std::find_if(schemes().begin(), schemes().end(),
                                  [&](const SchemeEntry& entry) { return entry.name == name; });
  return found->make(wall);
}

}  // namespace tunica::stepping
