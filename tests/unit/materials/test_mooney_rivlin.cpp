#include <Teuchos_UnitTestHarness.hpp>

#include "oracle/mooney_rivlin_energy.hpp"
#include "oracle/strain.hpp"
#include "tunica/materials/mooney_rivlin.hpp"

namespace {

using namespace tunica;
using oracle::cauchy_green;
using oracle::Deviation;
using oracle::random_strain;
using oracle::Samples;
using oracle::voigt;

const materials::MooneyRivlin law(3.0, 0.3);
const oracle::MooneyRivlinEnergy exact{3.0, 0.3};

TEUCHOS_UNIT_TEST(MooneyRivlin, energy_is_that_of_the_invariants) {
  Samples samples(1);
  for (int trial = 0; trial < 20; ++trial) {
    const auto E = random_strain(samples);
    TEST_FLOATING_EQUALITY(law.energy(voigt(E), {}), exact(cauchy_green(E)), 1e-12);
  }
}

TEUCHOS_UNIT_TEST(MooneyRivlin, stress_and_tangent_are_derivatives_of_energy) {
  Samples samples(2);
  for (int trial = 0; trial < 20; ++trial) {
    const auto E = random_strain(samples);
    std::array<oracle::Second<6>, 6> x;
    for (int I = 0; I < 6; ++I) oracle::seed(x[I], I, E[I]);
    const oracle::Second<6> Psi = exact(cauchy_green(x));
    const materials::StressTangent found = law.response(voigt(E), {});
    const Sym3 stress = law.stress(voigt(E), {});
    Deviation of_stress, of_response, of_tangent;
    for (int I = 0; I < 6; ++I) {
      of_stress.add(stress[I], Psi.dx(I).val());
      of_response.add(found.S[I], Psi.dx(I).val());
      for (int J = 0; J < 6; ++J) of_tangent.add(found.D[I][J], Psi.dx(I).dx(J));
    }
    TEST_COMPARE(of_stress.relative(), <, 1e-12);
    TEST_COMPARE(of_response.relative(), <, 1e-12);
    TEST_COMPARE(of_tangent.relative(), <, 1e-12);
  }
}

TEUCHOS_UNIT_TEST(MooneyRivlin, tangent_at_rest_has_shear_modulus_c10_plus_c01) {
  const materials::StressTangent rest = law.response({1, 1, 1, 0, 0, 0}, {});
  for (int I = 3; I < 6; ++I) TEST_FLOATING_EQUALITY(rest.D[I][I], 3.3, 1e-14);
  TEST_FLOATING_EQUALITY(law.stabilisation_modulus(), 6.6, 1e-14);
}

TEUCHOS_UNIT_TEST(MooneyRivlin, uniform_dilatation_costs_no_energy) {
  const Sym3 C{1.44, 1.44, 1.44, 0, 0, 0};
  TEST_COMPARE(std::abs(law.energy(C, {})), <, 1e-14);
  for (const double S : law.stress(C, {})) TEST_COMPARE(std::abs(S), <, 1e-14);
}

}  // namespace
