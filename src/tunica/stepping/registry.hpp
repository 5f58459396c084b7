#pragma once
#include <functional>
#include <memory>

#include "tunica/params/table.hpp"
#include "tunica/stepping/time_scheme.hpp"

namespace tunica::stepping {

/// A time scheme that a wall's list can name.
struct SchemeEntry {
  std::string name;
  std::string list;     ///< of its keys in the wall's list; empty where it has none
  params::Table table;  ///< these keys
  std::function<std::unique_ptr<TimeScheme>(const Teuchos::ParameterList& wall)> make;
};
/// The first is the default.
const std::vector<SchemeEntry>& schemes();

/// Adds the key "time scheme", and the lists of those that have one.
void add_scheme_keys(params::Table& table);
/// The scheme that a resolved "Wall" list names.
std::unique_ptr<TimeScheme> make_scheme(const Teuchos::ParameterList& wall);

}  // namespace tunica::stepping
