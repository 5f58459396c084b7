#include "tunica/materials/newtonian.hpp"

namespace tunica::materials {

ViscosityEntry newtonian() {
  const Constant viscosity{"viscosity",
                           std::numeric_limits<double>::quiet_NaN(),
                           0.0,
                           "kPa ms",
                           "dynamic viscosity; 0.035 Poise are 3.5e-6 kPa s = 3.5e-3 kPa ms",
                           std::numeric_limits<double>::infinity(),
                           true};
  return {"newtonian", "Of constant viscosity.", {viscosity}, [](const Constants& value) {
            return std::make_unique<Newtonian>(value.at("viscosity"));
          }};
}

}  // namespace tunica::materials
