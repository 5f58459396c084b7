#include "tunica/discretisation/law_keys.hpp"

#include <cmath>
#include <optional>

namespace tunica::discretisation {

void add_constant_keys(const std::vector<materials::Constant>& constants, params::Table& table) {
  for (const materials::Constant& c : constants)
    table.number(c.name, std::isnan(c.fallback) ? std::nullopt : std::optional(c.fallback),
                 {c.low, c.high, c.is_low_excluded, false}, c.unit, c.sentence);
}

materials::Constants constants_in(const Teuchos::ParameterList& list,
                                  const std::vector<materials::Constant>& constants) {
  materials::Constants values;
  for (const materials::Constant& c : constants) values[c.name] = list.get<double>(c.name);
  return values;
}

}  // namespace tunica::discretisation
