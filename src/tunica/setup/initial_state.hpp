#pragma once
#include "tunica/setup/run_settings.hpp"

namespace tunica::setup {

/// Adds the key "initial state" to a "Time" list.
void add_initial_state_key(params::Table& time);

/// Of a resolved "Time" list; none where the key is empty.
std::optional<InitialState> initial_state(const Teuchos::ParameterList& time);

/// Makes a relative folder of another run one that the case's own folder holds.
void place_initial_state(Teuchos::ParameterList& time, const std::string& folder_of_case);

/// Where a resolved case begins with the fields of another run, its windkessels begin with the
/// pressures that those of the same name had stored, as steps.csv of that run has them. Returns a
/// sentence about them, or nothing. Throws Error where the run has no such step. Not collective.
std::string take_outlet_pressures(Teuchos::ParameterList& the_case);

}  // namespace tunica::setup
