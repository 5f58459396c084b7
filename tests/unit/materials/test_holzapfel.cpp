#include <Teuchos_UnitTestHarness.hpp>

#include "oracle/holzapfel_energy.hpp"
#include "oracle/strain.hpp"
#include "tunica/base/error.hpp"
#include "tunica/materials/holzapfel.hpp"

namespace {

using namespace tunica;
using materials::Frame;
using materials::Holzapfel;
using oracle::Deviation;
using oracle::HolzapfelEnergy;
using oracle::Samples;
using oracle::voigt;
using Strain = std::array<double, 6>;

const HolzapfelEnergy media{3.0, 0.0, 2.3632, 0.8393, 29.0, 0.0, {}};
const HolzapfelEnergy adventitia{0.3, 0.0, 0.562, 0.7112, 62.0, 0.0, {}};
const HolzapfelEnergy dispersed{1.0, 0.4, 5.0, 2.0, 40.0, 0.2, {}};
const HolzapfelEnergy variants[] = {media, adventitia, dispersed};

Holzapfel law_of(const HolzapfelEnergy& e) {
  return {{e.c10, e.c01}, {e.k1, e.k2, e.degrees, e.dispersion}};
}

/// How many families of fibres are stretched.
int stretched(const HolzapfelEnergy& energy, const Strain& E) {
  const auto C = oracle::cauchy_green(E);
  return (energy.fibre_strain(C, 1) > 0.0) + (energy.fibre_strain(C, -1) > 0.0);
}

/// Largest relative deviation of energy, stress and tangent from automatic differentiation.
double deviation_at(const HolzapfelEnergy& energy, const Strain& E) {
  std::array<oracle::Second<6>, 6> x;
  for (int I = 0; I < 6; ++I) oracle::seed(x[I], I, E[I]);
  const oracle::Second<6> Psi = energy(oracle::cauchy_green(x));
  const Holzapfel law = law_of(energy);
  const materials::StressTangent found = law.response(voigt(E), energy.frame);
  const Sym3 stress = law.stress(voigt(E), energy.frame);
  Deviation of_energy, of_stress, of_response, of_tangent;
  of_energy.add(law.energy(voigt(E), energy.frame), Psi.val().val());
  for (int I = 0; I < 6; ++I) {
    of_stress.add(stress[I], Psi.dx(I).val());
    of_response.add(found.S[I], Psi.dx(I).val());
    for (int J = 0; J < 6; ++J) of_tangent.add(found.D[I][J], Psi.dx(I).dx(J));
  }
  return std::max(
      {of_energy.relative(), of_stress.relative(), of_response.relative(), of_tangent.relative()});
}

TEUCHOS_UNIT_TEST(Holzapfel, stress_and_tangent_are_derivatives_of_energy) {
  Samples samples(61);
  for (HolzapfelEnergy energy : variants) {
    int trials[3] = {0, 0, 0};
    double largest = 0.0;
    for (int trial = 0; trial < 500; ++trial) {
      energy.frame = oracle::random_frame(samples);
      const auto E = oracle::random_strain(samples);
      ++trials[stretched(energy, E)];
      largest = std::max(largest, deviation_at(energy, E));
    }
    TEST_COMPARE(largest, <, 1e-11);
    for (const int n : trials) TEST_COMPARE(n, >, 0);  // none, one and both families stretched
  }
}

TEUCHOS_UNIT_TEST(Holzapfel, stress_and_tangent_are_those_of_the_energy_next_to_the_switch) {
  Samples samples(64);
  for (const HolzapfelEnergy& energy : variants)
    for (const double e : {1e-9, -1e-9}) {
      Strain E = oracle::random_strain(samples);
      E[3] = E[4] = E[5] = 0.0;
      double low = -0.49, high = 4.0;  // C_θθ from 0.02 to 9
      for (int k = 0; k < 100; ++k) {
        E[1] = 0.5 * (low + high);
        (energy.fibre_strain(oracle::cauchy_green(E), 1) < e ? low : high) = E[1];
      }
      TEST_FLOATING_EQUALITY(energy.fibre_strain(oracle::cauchy_green(E), 1), e, 1e-5);
      TEST_COMPARE(deviation_at(energy, E), <, 1e-11);
    }
}

TEUCHOS_UNIT_TEST(Holzapfel, round_off_at_rest_does_not_switch_fibres_on) {
  const Holzapfel law = law_of(media);
  const materials::MooneyRivlin matrix(3.0, 0.0);
  const Sym3 C{1.0, 1.0 + 1e-15, 1.0, 1e-15, 0, 0};
  TEST_ASSERT(law.stress(C, {}) == matrix.stress(C, {}));
  TEST_ASSERT(law.response(C, {}).D == matrix.response(C, {}).D);
  TEST_EQUALITY(law.energy(C, {}), matrix.energy(C, {}));
}

TEUCHOS_UNIT_TEST(Holzapfel, compressed_fibres_leave_the_matrix_alone) {
  const Holzapfel law = law_of(media);
  const materials::MooneyRivlin matrix(3.0, 0.0);
  const Sym3 C{1.5, 0.6, 0.8, 0.1, 0.05, -0.02};
  TEST_ASSERT(law.stress(C, {}) == matrix.stress(C, {}));
  TEST_ASSERT(law.response(C, {}).D == matrix.response(C, {}).D);
}

TEUCHOS_UNIT_TEST(Holzapfel, stress_turns_with_body_and_fibres) {
  Samples samples(62);
  const auto turned = [](const Mat3& Q, const Sym3& A) {
    const Mat3 M = {{{A[0], A[3], A[5]}, {A[3], A[1], A[4]}, {A[5], A[4], A[2]}}};
    const auto entry = [&](int i, int j) { return dot(Q[i], M * Q[j]); };
    return Sym3{entry(0, 0), entry(1, 1), entry(2, 2), entry(0, 1), entry(1, 2), entry(2, 0)};
  };
  for (HolzapfelEnergy energy : variants)
    for (int trial = 0; trial < 10; ++trial) {
      const Frame f = oracle::random_frame(samples);
      const Mat3 Q = samples.rotation();
      const Sym3 C = voigt(oracle::random_strain(samples));
      const Holzapfel law = law_of(energy);
      const Sym3 expected = turned(Q, law.stress(C, f));
      const Sym3 found =
          law.stress(turned(Q, C), {Q * f.radial, Q * f.circumferential, Q * f.axial});
      Deviation of_stress;
      for (int I = 0; I < 6; ++I) of_stress.add(found[I], expected[I]);
      TEST_COMPARE(of_stress.relative(), <, 1e-12);
    }
}

TEUCHOS_UNIT_TEST(Holzapfel, full_dispersion_has_no_direction) {
  Samples samples(63);
  const Holzapfel law({3.0, 0.0}, {2.0, 1.0, 30.0, 1.0 / 3.0});
  const Sym3 C = voigt(oracle::random_strain(samples));
  TEST_FLOATING_EQUALITY(law.energy(C, oracle::random_frame(samples)),
                         law.energy(C, oracle::random_frame(samples)), 1e-13);
  TEST_COMPARE(law.energy(C, {}), >, materials::MooneyRivlin(3.0, 0.0).energy(C, {}));
}

TEUCHOS_UNIT_TEST(Holzapfel, a_stretch_out_of_all_bounds_is_no_number_to_go_on_with) {
  const Holzapfel law = law_of(media);
  for (const double stretch : {4.0, 1e3, 1e80}) {
    const Sym3 C{1.0 / stretch, stretch * stretch, 1.0 / stretch, 0, 0, 0};
    TEST_ASSERT(!std::isfinite(law.energy(C, {})));
    TEST_ASSERT(!std::isfinite(law.stress(C, {})[1]));
    TEST_ASSERT(!std::isfinite(law.response(C, {}).S[1]));
  }
  const Sym3 strong{0.5, 4.0, 0.5, 0, 0, 0};
  TEST_ASSERT(std::isfinite(law.stress(strong, {})[1]));
}

TEUCHOS_UNIT_TEST(Holzapfel, stabilisation_takes_the_papers_modulus) {
  TEST_FLOATING_EQUALITY(law_of(media).stabilisation_modulus(),
                         2.0 * (3.0 + 2.3632 / (2.0 * 0.8393)), 1e-14);
}

TEUCHOS_UNIT_TEST(Holzapfel, constants_out_of_range_are_refused) {
  const std::pair<const char*, double> wrong[] = {
      {"fibre angle", 129.0}, {"dispersion", 0.34}, {"k2", 0.0}, {"k1", -1.0}};
  for (const auto& [name, value] : wrong)
    TEST_THROW(materials::make_law("holzapfel", {{name, value}}), Error);
  TEST_ASSERT(materials::make_law("holzapfel", {{"dispersion", 1.0 / 3.0}})->has_fibres());
}

}  // namespace
