#include "tunica/judge/units.hpp"

#include <cmath>
#include <cstdio>

#include "tunica/boundary/registry.hpp"
#include "tunica/discretisation/fluid_options.hpp"
#include "tunica/discretisation/solid_options.hpp"
#include "tunica/judge/stiffness.hpp"
#include "tunica/materials/viscosity_law.hpp"

namespace tunica::judge {

namespace {

/// A quantity of vessels: what lies outside is doubted.
struct Quantity {
  const char* unit;
  double low, high;   ///< beyond which units are probably wrong
  const char* usual;  ///< with the factors from other units
};

// The upper bound lies between blood and what is ten times as much, blood in Poise.
constexpr Quantity viscosity{
    "kPa ms (= Pa s)", 3e-4, 0.02,
    "blood has 0.0035 kPa ms, water 0.001; 0.04 P = 0.004 kPa ms, 1 cP = 1 mPa s = 0.001 kPa ms"};
constexpr Quantity density{"mg/mm^3 (= g/cm^3)", 0.05, 5.0,
                           "blood has 1.06 mg/mm^3, walls 1.1 to 1.2; 1000 kg/m^3 = 1 mg/mm^3"};
constexpr Quantity pressure{"kPa", 0.0, 50.0,
                            "arteries have 8 to 25 kPa; 120 mmHg = 16 kPa, 1e4 dyn/cm^2 = 1 kPa"};
constexpr Quantity modulus{"kPa", 0.5, 1e5, "walls have 20 to 5000 kPa; 1 MPa = 1000 kPa"};
constexpr Quantity period{"ms", 50.0, 1e5, "a heart beats every 600 to 1200 ms; 0.8 s = 800 ms"};
constexpr Quantity decay{"ms", 10.0, 1e5,
                         "distal resistance times capacitance is 500 to 3000 ms; 1 mmHg s/ml = "
                         "0.1333 kPa ms/mm^3, 1 ml/mmHg = 7501 mm^3/kPa"};

std::string number(double value) {
  char text[40];
  std::snprintf(text, sizeof text, "%.4g", value);
  return text;
}

void doubt(const std::string& what, double value, const Quantity& quantity,
           std::vector<std::string>& doubts) {
  if (value == 0.0 || (std::abs(value) >= quantity.low && std::abs(value) <= quantity.high)) return;
  doubts.push_back(what + " is " + number(value) + " " + quantity.unit + "; " + quantity.usual +
                   ". Check the unit of this value.");
}

}  // namespace

std::vector<std::string> doubts_of_units(const setup::Case& the_case, const Loads& loads) {
  std::vector<std::string> doubts;
  if (the_case.fluid) {
    const discretisation::FluidOptions& fluid = the_case.fluid->options;
    doubt("Fluid / density", fluid.density, density, doubts);
    doubt("Fluid / viscosity", fluid.viscosity->reference(), viscosity, doubts);
    for (const auto& c : the_case.fluid->options.conditions)
      if (const auto outlet = c.drive(boundary::Field::fluid).outlet)
        doubt("Fluid / Surfaces / " + c.surface + ": the time constant", outlet->time_constant,
              decay, doubts);
  }
  if (the_case.wall)
    for (const auto& layer : the_case.wall->options.layers) {
      const std::string where = "Wall / Layers / " + layer.region;
      doubt(where + " / density", layer.density, density, doubts);
      doubt(where + ": Young's modulus at small strain",
            circumferential_modulus(*discretisation::law_of(layer), layer.bulk_modulus), modulus,
            doubts);
    }
  if (loads.peak_pressure > pressure.high)
    doubt(loads.pressure_surface + ": the largest pressure", loads.peak_pressure, pressure, doubts);
  for (const double T : loads.periods) doubt("an Amplitude's period", T, period, doubts);
  return doubts;
}

}  // namespace tunica::judge
