#include "tunica/stepping/clock.hpp"

namespace tunica::stepping {

params::Table time_table() {
  params::Table table("Equidistant time steps.");
  table.number("step size", std::nullopt, params::positive(), "ms", "time step Δt")
      .integer("steps", std::nullopt, params::between(1, 1e9), "number of time steps");
  return table;
}

}  // namespace tunica::stepping
