#pragma once
#include <string>

namespace tunica::observe {

/// Columns of powers, with their signs in the balance of energy.
struct Power {
  const char* name;
  double sign;
};
inline constexpr Power powers[] = {
    {"load_power", 1},      {"reaction_power", 1},       {"kinetic_inflow", 1},
    {"viscous_power", -1},  {"backflow_power", -1},      {"divergence_power", 1},
    {"interface_power", 1}, {"stabilisation_power", -1}, {"wall_stabilisation_power", -1},
    {"power_error", 1}};
/// What the discretisation takes out or brings in, and half of whose sizes is what is put in.
inline constexpr const char* powers_of_scheme[] = {"divergence_power", "stabilisation_power",
                                                   "wall_stabilisation_power", "interface_power",
                                                   "scheme_power"};
inline constexpr const char* physical_powers[] = {"load_power",     "reaction_power",
                                                  "kinetic_inflow", "viscous_power",
                                                  "backflow_power", "energy_change"};
inline constexpr const char* power_unit = "_kPa_mm3_per_ms";

/// Column of a component of a force.
inline std::string force_column(const std::string& name, int i) {
  return name + "_" + "xyz"[i] + "_mN";
}

}  // namespace tunica::observe
