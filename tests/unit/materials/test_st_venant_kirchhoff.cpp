#include <Teuchos_UnitTestHarness.hpp>

#include "oracle/strain.hpp"
#include "tunica/materials/st_venant_kirchhoff.hpp"

namespace {

using namespace tunica;
using oracle::Deviation;
using oracle::random_strain;
using oracle::Samples;
using oracle::voigt;

constexpr double E_modulus = 100.0, nu = 0.35;
constexpr double mu = E_modulus / (2.0 * (1.0 + nu));
constexpr double lambda = E_modulus * nu / ((1.0 + nu) * (1.0 - 2.0 * nu));
constexpr double kappa = lambda + 2.0 / 3.0 * mu;
const materials::StVenantKirchhoff law(E_modulus, nu);

/// λ/2 (tr E)² + μ E:E of Voigt's strain with engineering shears.
template <class S>
S plain_energy(const std::array<S, 6>& E) {
  const S trace = E[0] + E[1] + E[2];
  const S normal = E[0] * E[0] + E[1] * E[1] + E[2] * E[2];
  const S shear = E[3] * E[3] + E[4] * E[4] + E[5] * E[5];
  return 0.5 * lambda * trace * trace + mu * (normal + 0.5 * shear);
}

template <class S>
S determinant_of_F(const std::array<S, 6>& E) {
  return sqrt(oracle::determinant(oracle::cauchy_green(E)));
}

TEUCHOS_UNIT_TEST(StVenantKirchhoff, stress_and_tangent_are_derivatives_of_energy) {
  Samples samples(3);
  for (int trial = 0; trial < 20; ++trial) {
    const auto E = random_strain(samples);
    std::array<oracle::Second<6>, 6> x;
    for (int I = 0; I < 6; ++I) oracle::seed(x[I], I, E[I]);
    const oracle::Second<6> change = determinant_of_F(x) - 1.0;
    const oracle::Second<6> Psi = plain_energy(x) - 0.5 * kappa * change * change;
    TEST_FLOATING_EQUALITY(law.energy(voigt(E), {}), Psi.val().val(), 1e-10);
    const materials::StressTangent found = law.response(voigt(E), {});
    Deviation of_stress, of_tangent;
    for (int I = 0; I < 6; ++I) {
      of_stress.add(found.S[I], Psi.dx(I).val());
      for (int J = 0; J < 6; ++J) of_tangent.add(found.D[I][J], Psi.dx(I).dx(J));
    }
    TEST_COMPARE(of_stress.relative(), <, 1e-11);
    TEST_COMPARE(of_tangent.relative(), <, 1e-11);
  }
}

TEUCHOS_UNIT_TEST(StVenantKirchhoff, with_the_pressure_it_is_the_plain_law) {
  // S' − p J C⁻¹ at p = −κ (J − 1) is λ tr E I + 2μ E.
  const materials::LawEntry entry = materials::st_venant_kirchhoff();
  TEST_FLOATING_EQUALITY(entry.bulk_modulus({{"young modulus", E_modulus}, {"poisson ratio", nu}}),
                         kappa, 1e-14);
  Samples samples(4);
  for (int trial = 0; trial < 20; ++trial) {
    const auto E = random_strain(samples);
    std::array<oracle::First<6>, 6> x;
    for (int I = 0; I < 6; ++I) oracle::seed(x[I], I, E[I]);
    const oracle::First<6> J = determinant_of_F(x);
    const Sym3 S = law.stress(voigt(E), {});
    const double trace = E[0] + E[1] + E[2];
    Deviation deviation;
    for (int I = 0; I < 6; ++I) {
      const double of_volume = kappa * (J.val() - 1.0) * J.dx(I);
      const double plain = I < 3 ? lambda * trace + 2.0 * mu * E[I] : mu * E[I];
      deviation.add(S[I] + of_volume, plain);
    }
    TEST_COMPARE(deviation.relative(), <, 1e-12);
  }
}

TEUCHOS_UNIT_TEST(StVenantKirchhoff, tangent_at_rest_is_deviatoric) {
  const materials::StressTangent rest = law.response({1, 1, 1, 0, 0, 0}, {});
  TEST_FLOATING_EQUALITY(rest.D[0][0], 4.0 / 3.0 * mu, 1e-13);
  TEST_FLOATING_EQUALITY(rest.D[0][1], -2.0 / 3.0 * mu, 1e-13);
  TEST_FLOATING_EQUALITY(rest.D[3][3], mu, 1e-13);
  TEST_FLOATING_EQUALITY(law.stabilisation_modulus(), 2.0 * mu, 1e-14);
}

}  // namespace
