#include "tunica/stepping/newmark.hpp"

namespace tunica::stepping {

params::Table newmark_table() {
  params::Table table("Newmark's time integration of the wall.");
  table
      .number("beta", 0.625, params::Range{0.0, 1.0, true, false}, "1",
              "β; more than 0.5 keeps the pressure free of oscillations in time")
      .number("gamma", 1.0, params::between(0.5, 1.0), "1", "γ; 1 is the first-order scheme");
  return table;
}

}  // namespace tunica::stepping
