#pragma once
#include <array>
#include <string>
#include <vector>

namespace tunica::discretisation {

/// A number that characterises the state, a column of steps.csv.
struct Observable {
  std::string name;  ///< with its unit, as "max_displacement_wall_mm"
  double value;
};
using Observables = std::vector<Observable>;

/// Adds the components of a vector, as "wall_force_inlet_x_mN".
inline void add_vector(const std::string& name, const std::string& unit,
                       const std::array<double, 3>& value, Observables& found) {
  for (int i = 0; i < 3; ++i) found.push_back({name + "_" + "xyz"[i] + "_" + unit, value[i]});
}

}  // namespace tunica::discretisation
