#include <Teuchos_UnitTestHarness.hpp>

#include "materials/mooney_rivlin.hpp"
#include "oracle/mooney_rivlin_energy.hpp"
#include "oracle/samples.hpp"

namespace {

using namespace tunica;
using oracle::Deviation;
using oracle::Samples;

const materials::MooneyRivlin law(3.0, 0.3);
const oracle::MooneyRivlinEnergy exact{3.0, 0.3};

/// C = I + 2E for Voigt strain E with engineering shears.
template <class S>
oracle::Mat<S> cauchy_green(const std::array<S, 6>& E) {
  return {{{S(1.0 + 2.0 * E[0]), E[3], E[5]},
           {E[3], S(1.0 + 2.0 * E[1]), E[4]},
           {E[5], E[4], S(1.0 + 2.0 * E[2])}}};
}

std::array<double, 6> random_strain(Samples& samples) {
  oracle::Mat<double> F = {{samples.vector(0.4), samples.vector(0.4), samples.vector(0.4)}};
  for (int i = 0; i < 3; ++i) F[i][i] += 1.2;
  const oracle::Mat<double> C = oracle::gram(F);
  return {0.5 * (C[0][0] - 1), 0.5 * (C[1][1] - 1), 0.5 * (C[2][2] - 1), C[0][1], C[1][2], C[2][0]};
}

Sym3 voigt(const std::array<double, 6>& E) {
  return {1 + 2 * E[0], 1 + 2 * E[1], 1 + 2 * E[2], E[3], E[4], E[5]};
}

TEUCHOS_UNIT_TEST(MooneyRivlin, energy_is_that_of_the_invariants) {
  Samples samples(1);
  for (int trial = 0; trial < 20; ++trial) {
    const auto E = random_strain(samples);
    TEST_FLOATING_EQUALITY(law.energy(voigt(E)), exact(cauchy_green(E)), 1e-12);
  }
}

TEUCHOS_UNIT_TEST(MooneyRivlin, stress_and_tangent_are_derivatives_of_energy) {
  Samples samples(2);
  for (int trial = 0; trial < 20; ++trial) {
    const auto E = random_strain(samples);
    std::array<oracle::Second<6>, 6> x;
    for (int I = 0; I < 6; ++I) oracle::seed(x[I], I, E[I]);
    const oracle::Second<6> Psi = exact(cauchy_green(x));
    const materials::Response found = law.response(voigt(E));
    const Sym3 stress = law.stress(voigt(E));
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
  const materials::Response rest = law.response({1, 1, 1, 0, 0, 0});
  for (int I = 3; I < 6; ++I) TEST_FLOATING_EQUALITY(rest.D[I][I], 3.3, 1e-14);
  TEST_FLOATING_EQUALITY(law.stabilisation_modulus(), 6.6, 1e-14);
}

TEUCHOS_UNIT_TEST(MooneyRivlin, uniform_dilatation_costs_no_energy) {
  const Sym3 C{1.44, 1.44, 1.44, 0, 0, 0};
  TEST_COMPARE(std::abs(law.energy(C)), <, 1e-14);
  for (const double S : law.stress(C)) TEST_COMPARE(std::abs(S), <, 1e-14);
}

}  // namespace
