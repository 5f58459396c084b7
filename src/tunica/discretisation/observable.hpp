#pragma once
#include <array>
#include <string>
#include <vector>

#include "tunica/base/tensor.hpp"

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

/// What the equations of a field say of a step as a whole, at its end: sums over the nodes and
/// elements that this rank owns; see balance.cpp. Forces act on the field [mN].
struct Balance {
  Vec3 loads{};                 ///< of the terms of its surfaces, and of body forces
  Vec3 reactions{};             ///< of what prescribes its velocity or displacement
  Vec3 interface {};            ///< of the other field
  Vec3 error{};                 ///< that is left where nothing is prescribed
  Vec3 momentum{};              ///< [mg mm/ms]
  Vec3 outflow{};               ///< momentum that the fluid takes along through its surfaces
  double forces = 0.0;          ///< sizes of the first three, node by node
  double force_residual = 0.0;  ///< sizes of what is left, node by node
  double load_power = 0.0, reaction_power = 0.0, interface_power = 0.0;  ///< [kPa mm³/ms]
  double power_error = 0.0;  ///< of what is left of all equations
  double volume = 0.0;       ///< as it is deformed [mm³]
  /// Of a fluid: outflow through all of its boundary, and what that sweeps as the mesh moves, half
  /// of the flows through its triangles; sizes of what is left of the continuity [mm³/ms].
  double net_outflow = 0.0, swept = 0.0, throughput = 0.0, mass_residual = 0.0;
  double volume_error = 0.0;  ///< of a wall: ∫ J − 1 + p/κ dV [mm³]
  /// Of a wall: elements that are nearly incompressible, by det F; see volume_ratio_bins.
  std::vector<double> volume_ratios{};

  /// All numbers, for sums over ranks.
  template <class Do>
  void each(const Do& f) {
    for (Vec3* v : {&loads, &reactions, &interface, &error, &momentum, &outflow})
      for (double& number : *v) f(number);
    for (double* number :
         {&forces, &force_residual, &load_power, &reaction_power, &interface_power, &power_error,
          &volume, &net_outflow, &swept, &throughput, &mass_residual, &volume_error})
      f(*number);
    for (double& number : volume_ratios) f(number);
  }
};

}  // namespace tunica::discretisation
