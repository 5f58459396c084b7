#pragma once
#include <memory>

#include "tunica/stepping/time_scheme.hpp"

namespace tunica::stepping {

/// The first is the default.
const std::vector<SchemeEntry>& schemes();

/// Adds the key "time scheme", and the lists of those that have one.
void add_scheme_keys(params::Table& table);
/// The scheme that a resolved "Wall" list names.
std::unique_ptr<TimeScheme> make_scheme(const Teuchos::ParameterList& wall);

}  // namespace tunica::stepping
