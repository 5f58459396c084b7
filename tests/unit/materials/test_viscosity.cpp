#include <Teuchos_UnitTestHarness.hpp>
#include <cmath>

#include "tunica/materials/carreau_yasuda.hpp"
#include "tunica/materials/newtonian.hpp"

namespace {

using namespace tunica;
using materials::CarreauYasuda;
using materials::Viscosity;

TEUCHOS_UNIT_TEST(viscosity, of_a_newtonian_fluid_does_not_change) {
  const materials::Newtonian law(0.7);
  for (const double rate : {0.0, 0.3, 1e4}) {
    const Viscosity mu = law.at(rate);
    TEST_EQUALITY(mu.value, 0.7);
    TEST_EQUALITY(mu.slope, 0.0);
  }
  TEST_ASSERT(law.is_constant());
}

TEUCHOS_UNIT_TEST(viscosity, of_carreaus_law_by_hand) {
  // (λγ̇)² = 3: 0.1 + 0.3 · 4^(−1/4)
  const CarreauYasuda law({0.4, 0.1, 2.0, 0.5, 2.0});
  TEST_FLOATING_EQUALITY(law.at(0.75).value, 0.1 + 0.3 / std::sqrt(2.0), 1e-14);
  TEST_EQUALITY(law.at(0.0).value, 0.4);
  TEST_FLOATING_EQUALITY(law.at(1e40).value, 0.1, 1e-8);
  TEST_EQUALITY(law.reference(), 0.1);
  TEST_ASSERT(!law.is_constant());
}

TEUCHOS_UNIT_TEST(viscosity, slope_is_that_of_the_value) {
  for (const CarreauYasuda& law :
       {CarreauYasuda({0.4, 0.1, 2.0, 0.5, 2.0}), CarreauYasuda({0.3, 0.02, 1.3, 0.2, 1.25}),
        CarreauYasuda({0.3, 0.02, 1.3, 1.0, 0.7})})
    for (const double q : {1e-4, 0.1, 3.0, 500.0}) {
      const double h = 1e-5 * q;
      const double difference = (law.at(q + h).value - law.at(q - h).value) / (2.0 * h);
      TEST_COMPARE(std::abs(law.at(q).slope - difference), <=, 1e-7 * std::abs(difference));
    }
}

TEUCHOS_UNIT_TEST(viscosity, of_blood_by_default) {
  materials::Constants constants;
  for (const materials::ViscosityEntry& law : materials::viscosity_laws())
    for (const materials::Constant& c : law.constants)
      if (law.name == "carreau-yasuda") constants[c.name] = c.fallback;
  const auto blood = materials::make_viscosity_law("carreau-yasuda", constants);
  // 100/s, mPa s: 3.45 + 52.55 (1 + 331.3²)^−0.3216
  TEST_FLOATING_EQUALITY(1e3 * blood->at(0.1 * 0.1).value,
                         3.45 + 52.55 * std::exp(-0.3216 * std::log(1.0 + 331.3 * 331.3)), 1e-12);
}

}  // namespace
