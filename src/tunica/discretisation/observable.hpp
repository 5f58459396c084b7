#pragma once
#include <string>
#include <vector>

namespace tunica::discretisation {

/// A number that characterises the state, a column of steps.csv.
struct Observable {
  std::string name;  ///< with its unit, as "max_displacement_wall_mm"
  double value;
};
using Observables = std::vector<Observable>;

}  // namespace tunica::discretisation
