#pragma once
#include <memory>

#include "tunica/stepping/time_scheme.hpp"

namespace tunica::stepping {

/// The first is the default.
const std::vector<SchemeEntry>& schemes();

/// Adds the key "time scheme" of a wall, and the lists of those that have one.
void add_wall_scheme_keys(params::Table& table);
/// The scheme that a resolved "Wall" list names.
std::unique_ptr<TimeScheme> make_wall_scheme(const Teuchos::ParameterList& wall);

/// Adds the scheme keys of a fluid, whose equations are of first order in time.
void add_fluid_scheme_keys(params::Table& table);
std::unique_ptr<TimeScheme> make_fluid_scheme(const Teuchos::ParameterList& fluid);

}  // namespace tunica::stepping
