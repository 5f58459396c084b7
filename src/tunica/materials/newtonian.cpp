#include "tunica/materials/newtonian.hpp"

namespace tunica::materials {

ViscosityEntry newtonian() {
  Constant viscosity;
  viscosity.name = "viscosity";
  viscosity.fallback = std::numeric_limits<double>::quiet_NaN();
  viscosity.low = 0.0;
  viscosity.is_low_excluded = true;
  viscosity.unit = "kPa ms";
  viscosity.sentence = "dynamic viscosity; 0.035 Poise are 3.5e-6 kPa s = 3.5e-3 kPa ms";
  return {"newtonian", "Constant viscosity.", {viscosity}, [](const Constants& value) {
            return std::make_unique<Newtonian>(value.at("viscosity"));
          }};
}

}  // namespace tunica::materials
