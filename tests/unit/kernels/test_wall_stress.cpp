#include <Teuchos_UnitTestHarness.hpp>

#include "oracle/mooney_rivlin_energy.hpp"
#include "oracle/samples.hpp"
#include "tunica/kernels/principal_axes.hpp"
#include "tunica/kernels/wall_stress.hpp"
#include "tunica/materials/holzapfel.hpp"

namespace {

using namespace tunica;
using oracle::Deviation;
using oracle::Samples;

const materials::MooneyRivlin law(3.0, 0.3);

TEUCHOS_UNIT_TEST(WallStress, cauchy_stress_is_that_of_the_energy) {
  Samples samples(51);
  for (int trial = 0; trial < 10; ++trial) {
    const auto x = samples.tetrahedron();
    const auto d = samples.deformation(x, 0.25);
    const auto p = samples.numbers(5.0);
    const Sym3 sigma = kernels::cauchy_stress(kernels::make_tet4(x), d, p, law);

    // σ = J⁻¹ (∂Ψ'/∂F) Fᵀ − p̄ I
    oracle::Mat<double> F = oracle::gradient(d, oracle::Element(x).grad_N);
    oracle::Mat<oracle::First<9>> F_ad;
    for (int i = 0; i < 3; ++i)
      for (int j = 0; j < 3; ++j) {
        F[i][j] += i == j;
        oracle::seed(F_ad[i][j], 3 * i + j, F[i][j]);
      }
    const auto Psi = oracle::MooneyRivlinEnergy{3.0, 0.3}(oracle::gram(F_ad));
    const int row[6] = {0, 1, 2, 0, 1, 2}, column[6] = {0, 1, 2, 1, 2, 0};
    Deviation of_stress;
    for (int I = 0; I < 6; ++I) {
      double expected = I < 3 ? -0.25 * (p[0] + p[1] + p[2] + p[3]) : 0.0;
      for (int k = 0; k < 3; ++k)
        expected += Psi.dx(3 * row[I] + k) * F[column[I]][k] / oracle::determinant(F);
      of_stress.add(sigma[I], expected);
    }
    TEST_COMPARE(of_stress.relative(), <, 1e-12);
  }
}

TEUCHOS_UNIT_TEST(WallStress, uniaxial_stretch_of_neo_hooke_has_the_textbook_stress) {
  const double stretch = 1.3;
  const double across = 1.0 / std::sqrt(stretch);
  const std::array<Vec3, 4> x = {{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}}};
  const std::array<Vec3, 4> d = {
      {{0, 0, 0}, {stretch - 1, 0, 0}, {0, across - 1, 0}, {0, 0, across - 1}}};
  const Sym3 sigma = kernels::cauchy_stress(kernels::make_tet4(x), d, {2, 2, 2, 2},
                                            materials::MooneyRivlin(3.0, 0.0));
  const double expected = 3.0 * (stretch * stretch - 1.0 / stretch);
  TEST_FLOATING_EQUALITY(sigma[0] - sigma[1], expected, 1e-13);
  TEST_FLOATING_EQUALITY(sigma[0] - sigma[2], expected, 1e-13);
  TEST_FLOATING_EQUALITY(kernels::von_mises(sigma), expected, 1e-13);
}

TEUCHOS_UNIT_TEST(WallStress, stretch_along_the_fibres_has_their_stress_twice) {
  // S = 2 ∂Ψ/∂C: each family adds 2 k1 e exp(k2 e²) λ² with e = λ² − 1.
  const double stretch = 1.3, k1 = 2.0, k2 = 0.7;
  const double across = 1.0 / std::sqrt(stretch);
  const std::array<Vec3, 4> x = {{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}}};
  const std::array<Vec3, 4> d = {
      {{0, 0, 0}, {across - 1, 0, 0}, {0, across - 1, 0}, {0, 0, stretch - 1}}};
  const materials::Holzapfel artery({3.0, 0.0}, {k1, k2, 0.0, 0.0});
  const materials::Frame frame{{1, 0, 0}, {0, 0, 1}, {0, -1, 0}};  // circumference along z
  const Sym3 sigma = kernels::cauchy_stress(kernels::make_tet4(x), d, {2, 2, 2, 2}, artery, frame);
  const double e = stretch * stretch - 1.0;
  const double expected = 3.0 * (stretch * stretch - 1.0 / stretch) +
                          2.0 * 2.0 * k1 * e * std::exp(k2 * e * e) * stretch * stretch;
  TEST_FLOATING_EQUALITY(sigma[2] - sigma[0], expected, 1e-13);
  TEST_FLOATING_EQUALITY(sigma[2] - sigma[1], expected, 1e-13);
}

TEUCHOS_UNIT_TEST(WallStress, von_mises_ignores_pressure_and_counts_shear_with_root_three) {
  TEST_EQUALITY(kernels::von_mises({4, 4, 4, 0, 0, 0}), 0.0);
  TEST_FLOATING_EQUALITY(kernels::von_mises({0, 0, 0, 0, 2, 0}), 2.0 * std::sqrt(3.0), 1e-15);
  TEST_FLOATING_EQUALITY(kernels::von_mises({-5, 0, 0, 0, 0, 0}), 5.0, 1e-15);
}

TEUCHOS_UNIT_TEST(WallStress, principal_axes_are_those_of_a_turned_tensor) {
  const double c = std::cos(0.7), w = std::sin(0.7);
  const Mat3 about_z{{{c, -w, 0.0}, {w, c, 0.0}, {0.0, 0.0, 1.0}}};
  const Mat3 about_x{{{1.0, 0.0, 0.0}, {0.0, c, -w}, {0.0, w, c}}};
  for (const Vec3 values : {Vec3{5.0, 2.0, -3.0}, Vec3{1.0, 1.0, 1.0 - 1e-9}, Vec3{1e6, 1.0, 1e-6},
                            Vec3{4.0, 4.0, 4.0}, Vec3{0.0, 0.0, 0.0}}) {
    Mat3 A{};
    for (int i = 0; i < 3; ++i)
      for (int j = 0; j < 3; ++j)
        for (int k = 0; k < 3; ++k) {  // R diag Rᵀ with R = about_z about_x
          const Vec3 column{about_x[0][k], about_x[1][k], about_x[2][k]};
          const Vec3 r = about_z * column;
          A[i][j] += r[i] * values[k] * r[j];
        }
    const kernels::PrincipalAxes found =
        kernels::principal_axes({A[0][0], A[1][1], A[2][2], A[0][1], A[1][2], A[2][0]});
    const double round_off = 4e-15 * std::abs(values[0]) + 1e-300;
    for (int k = 0; k < 3; ++k) {
      const Vec3 q = found.directions[k];
      TEST_COMPARE(std::abs(found.values[k] - values[k]), <=, 0.5 * round_off);
      TEST_COMPARE(norm(A * q - found.values[k] * q), <=, round_off);
      TEST_COMPARE(norm(cross(q, found.directions[(k + 1) % 3])), >, 1.0 - 1e-14);
    }
  }
}

}  // namespace
