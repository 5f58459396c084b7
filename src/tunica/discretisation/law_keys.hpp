#pragma once
#include "tunica/materials/registry.hpp"
#include "tunica/params/table.hpp"

namespace tunica::discretisation {

/// Adds a key for each constant of a law; required where the constant has no fallback.
void add_constant_keys(const std::vector<materials::Constant>& constants, params::Table& table);
/// Their values in a resolved list.
materials::Constants constants_in(const Teuchos::ParameterList& list,
                                  const std::vector<materials::Constant>& constants);

}  // namespace tunica::discretisation
