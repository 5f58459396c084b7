#include <Teuchos_UnitTestHarness.hpp>

#include "oracle/samples.hpp"
#include "tunica/base/error.hpp"
#include "tunica/materials/registry.hpp"

namespace {

using namespace tunica;
using materials::make_law;

const Sym3 rest{1, 1, 1, 0, 0, 0};
const Sym3 stretched{1.3, 0.9, 1.1, 0.2, -0.1, 0.15};

TEUCHOS_UNIT_TEST(Registry, every_law_is_free_of_energy_and_stress_at_rest) {
  for (const auto& entry : materials::laws()) {
    const auto law = make_law(entry.name, {});
    TEST_COMPARE(std::abs(law->energy(rest, {})), <, 1e-14);
    for (const double S : law->stress(rest, {})) TEST_COMPARE(std::abs(S), <, 1e-14);
    TEST_COMPARE(law->stabilisation_modulus(), >, 0.0);
  }
}

TEUCHOS_UNIT_TEST(Registry, every_law_has_stress_and_tangent_of_its_energy) {
  constexpr double h = 1e-6;
  for (const auto& entry : materials::laws()) {
    const auto law = make_law(entry.name, {});
    const materials::StressTangent at = law->response(stretched, {});
    oracle::Deviation of_stress, of_tangent, of_response;
    for (int J = 0; J < 6; ++J) {
      Sym3 up = stretched, down = stretched;
      const double dE = J < 3 ? 0.5 * h : h;  // C_xx = 1 + 2 E_xx, C_xy = 2 E_xy
      up[J] += h;
      down[J] -= h;
      of_stress.add((law->energy(up, {}) - law->energy(down, {})) / (2 * dE), at.S[J]);
      for (int I = 0; I < 6; ++I)
        of_tangent.add((law->stress(up, {})[I] - law->stress(down, {})[I]) / (2 * dE), at.D[I][J]);
      of_response.add(law->stress(stretched, {})[J], at.S[J]);
    }
    TEST_COMPARE(of_stress.relative(), <, 1e-8);
    TEST_COMPARE(of_tangent.relative(), <, 1e-8);
    TEST_COMPARE(of_response.relative(), <, 1e-14);
  }
}

TEUCHOS_UNIT_TEST(Registry, neo_hookean_is_mooney_rivlin_without_c01) {
  const auto neo = make_law("neo-hookean", {{"c10", 2.5}});
  const auto mooney = make_law("mooney-rivlin", {{"c10", 2.5}, {"c01", 0.0}});
  TEST_EQUALITY(neo->energy(stretched, {}), mooney->energy(stretched, {}));
  TEST_EQUALITY(neo->stabilisation_modulus(), 5.0);
}

TEUCHOS_UNIT_TEST(Registry, missing_constants_take_their_fallback) {
  const auto law = make_law("mooney-rivlin", {{"c01", 1.0}});
  TEST_EQUALITY(law->stabilisation_modulus(), 8.0);
}

TEUCHOS_UNIT_TEST(Registry, bad_input_stops_with_the_name_of_what_is_wrong) {
  const auto message = [](const std::string& name, const materials::Constants& constants) {
    try {
      make_law(name, constants);
    } catch (const Error& error) {
      return std::string(error.what());
    }
    return std::string();
  };
  const auto says = [](const std::string& text, const char* word) {
    return text.find(word) != std::string::npos;
  };
  TEST_ASSERT(says(message("rubber", {}), "\"neo-hookean\""));
  TEST_ASSERT(says(message("neo-hookean", {{"c01", 1.0}}), "unknown constant \"c01\""));
  TEST_ASSERT(says(message("mooney-rivlin", {{"c10", -1.0}}), "\"c10\" is -1 kPa"));
  TEST_ASSERT(says(message("mooney-rivlin", {{"c10", std::nan("")}}), "\"c10\""));
  TEST_ASSERT(says(message("neo-hookean", {{"c10", 0.0}}), "no stiffness"));
}

}  // namespace
