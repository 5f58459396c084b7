#include <Teuchos_UnitTestHarness.hpp>

#include "oracle/holzapfel_energy.hpp"
#include "oracle/samples.hpp"
#include "oracle/solid_weak_form.hpp"
#include "tunica/kernels/deformation.hpp"
#include "tunica/kernels/solid_up.hpp"
#include "tunica/materials/holzapfel.hpp"

namespace {

using namespace tunica;
using kernels::SolidCoefficients;
using kernels::SolidState;
using oracle::Deviation;
using oracle::Samples;

constexpr double alpha = 122.9, inv_kappa = 1e-5, tau = 2e-3;
constexpr double tau_v = 4.0;
const SolidCoefficients all_terms{alpha, inv_kappa, tau, tau_v};
const SolidCoefficients variants[] = {
    all_terms,         {alpha, inv_kappa, tau}, {0.0, inv_kappa, tau}, {0.0, 0.0, tau},
    {alpha, 0.0, tau}, {alpha, inv_kappa, 0.0}, {0.0, 0.3, tau, 2.0}};
const materials::MooneyRivlin law(3.0, 0.3);

struct Case {
  std::array<Vec3, 4> x;
  kernels::Tet4 T;
  SolidState s;

  explicit Case(Samples& samples) : x(samples.tetrahedron()), T(kernels::make_tet4(x)) {
    do {
      s.d = samples.deformation(x, 0.35);
    } while (kernels::solid_jacobian_determinant(T, s.d) < 0.3);
    s.p = samples.numbers(5.0);
    s.r = samples.vectors(20.0);
    s.subscale_r = samples.vector(15.0);
  }

  template <class Energy>
  oracle::SolidWeakForm<Energy> weak_form(const Energy& energy, const SolidCoefficients& c) const {
    return {oracle::Element(x), energy, c.alpha, c.inv_kappa, c.tau, s.r, s.subscale_r, c.tau_v};
  }
  auto weak_form(const SolidCoefficients& c) const {
    return weak_form(oracle::MooneyRivlinEnergy{3.0, 0.3}, c);
  }

  template <class S>
  std::array<S, 16> unknowns() const {
    std::array<S, 16> y;
    for (int a = 0; a < 4; ++a) {
      for (int i = 0; i < 3; ++i) oracle::seed(y[3 * a + i], 3 * a + i, s.d[a][i]);
      oracle::seed(y[12 + a], 12 + a, s.p[a]);
    }
    return y;
  }
};

TEUCHOS_UNIT_TEST(SolidUp, residual_without_pspg_is_gradient_of_potential) {
  Samples samples(11);
  for (int trial = 0; trial < 5; ++trial) {
    const Case test(samples);
    const SolidCoefficients c{alpha, 0.2, 0.0, tau_v};
    const auto Pi = test.weak_form(c).potential(test.unknowns<oracle::First<16>>());
    const kernels::MixedResidual R = solid_up_residual(test.T, test.s, law, c);
    Deviation of_u, of_p;
    for (int a = 0; a < 4; ++a) {
      for (int i = 0; i < 3; ++i) of_u.add(R.u[a][i], Pi.dx(3 * a + i));
      of_p.add(R.p[a], Pi.dx(12 + a));
    }
    TEST_COMPARE(of_u.relative(), <, 1e-12);
    TEST_COMPARE(of_p.relative(), <, 1e-12);
  }
}

TEUCHOS_UNIT_TEST(SolidUp, pspg_rows_are_those_of_the_weak_form) {
  Samples samples(12);
  for (int trial = 0; trial < 5; ++trial) {
    const Case test(samples);
    const auto rows = test.weak_form(all_terms).pspg(test.unknowns<double>());
    const auto with = solid_up_residual(test.T, test.s, law, all_terms);
    const auto without = solid_up_residual(test.T, test.s, law, {alpha, inv_kappa, 0.0, tau_v});
    Deviation of_p;
    for (int a = 0; a < 4; ++a) {
      of_p.add(with.p[a] - without.p[a], rows[a]);
      TEST_ASSERT(with.u[a] == without.u[a]);
    }
    TEST_COMPARE(of_p.relative(), <, 1e-10);
  }
}

/// The largest deviation of the four blocks from the derivatives of the weak form.
template <class WeakForm>
double jacobian_deviation(const Case& test, const WeakForm& form, const kernels::MixedJacobian& K) {
  const auto Pi = form.potential(test.unknowns<oracle::Second<16>>());
  const auto pspg = form.pspg(test.unknowns<oracle::First<16>>());
  Deviation A, B1T, B2, mC;
  for (int a = 0; a < 4; ++a)
    for (int b = 0; b < 4; ++b) {
      mC.add(K.mC[a][b], Pi.dx(12 + a).dx(12 + b) + pspg[a].dx(12 + b));
      for (int i = 0; i < 3; ++i) {
        B1T.add(K.B1T[a][b][i], Pi.dx(3 * a + i).dx(12 + b));
        B2.add(K.B2[a][b][i], Pi.dx(12 + a).dx(3 * b + i) + pspg[a].dx(3 * b + i));
        for (int j = 0; j < 3; ++j) A.add(K.A[a][b][i][j], Pi.dx(3 * a + i).dx(3 * b + j));
      }
    }
  return std::max({A.relative(), B1T.relative(), B2.relative(), mC.relative()});
}

TEUCHOS_UNIT_TEST(SolidUp, jacobian_is_derivative_of_residual) {
  Samples samples(13);
  for (const SolidCoefficients& c : variants)
    for (int trial = 0; trial < 4; ++trial) {
      const Case test(samples);
      kernels::MixedResidual R;
      kernels::MixedJacobian K;
      solid_up_jacobian(test.T, test.s, law, c, R, K);
      TEST_COMPARE(jacobian_deviation(test, test.weak_form(c), K), <, 1e-12);
    }
}

TEUCHOS_UNIT_TEST(SolidUp, subscale_is_what_the_continuity_rows_see) {
  // d' = −τ s̄, and the PSPG rows are −τ V s̄·g_a = V d'·g_a
  Samples samples(19);
  for (int trial = 0; trial < 5; ++trial) {
    const Case test(samples);
    const SolidCoefficients c{alpha, 0.0, tau}, unstabilised{alpha, 0.0, 0.0};
    const Vec3 d = solid_subscale(test.T, test.s, c);
    const auto with = solid_up_residual(test.T, test.s, law, c);
    const auto without = solid_up_residual(test.T, test.s, law, unstabilised);
    const Mat3 F = kernels::deformation_gradient(test.T, test.s.d);
    for (int a = 0; a < 4; ++a) {
      const Vec3 g = 1.0 / det(F) * (transpose(adjugate(F)) * test.T.grad_N[a]);
      TEST_FLOATING_EQUALITY(with.p[a] - without.p[a], test.T.volume * dot(d, g), 1e-10);
    }
  }
}

TEUCHOS_UNIT_TEST(SolidUp, both_entry_points_give_the_same_residual) {
  Samples samples(14);
  const Case test(samples);
  kernels::MixedResidual R;
  kernels::MixedJacobian K;
  solid_up_jacobian(test.T, test.s, law, all_terms, R, K);
  const auto alone = solid_up_residual(test.T, test.s, law, all_terms);
  Deviation of_u, of_p;
  for (int a = 0; a < 4; ++a) {
    for (int i = 0; i < 3; ++i) of_u.add(R.u[a][i], alone.u[a][i]);
    of_p.add(R.p[a], alone.p[a]);
  }
  TEST_COMPARE(of_u.relative(), <, 1e-14);
  TEST_COMPARE(of_p.relative(), <, 1e-14);
}

TEUCHOS_UNIT_TEST(SolidUp, rigid_motion_gives_no_force) {
  Samples samples(15);
  for (int trial = 0; trial < 10; ++trial) {
    Case test(samples);
    const Mat3 Q = samples.rotation();
    const Vec3 shift = samples.vector(2.0);
    for (int a = 0; a < 4; ++a) test.s.d[a] = Q * test.x[a] + shift - test.x[a];
    test.s.p = {0, 0, 0, 0};
    test.s.r = {};
    test.s.subscale_r = {};
    const auto R = solid_up_residual(test.T, test.s, law, {0.0, inv_kappa, tau});
    // relative to modulus × area, respectively volume
    for (int a = 0; a < 4; ++a) {
      TEST_COMPARE(norm(R.u[a]), <, 1e-13 * 3.3 * test.T.volume * norm(test.T.grad_N[a]) * 10);
      TEST_COMPARE(std::abs(R.p[a]), <, 1e-13 * test.T.volume);
    }
  }
}

TEUCHOS_UNIT_TEST(SolidUp, force_rotates_with_the_body) {
  Samples samples(16);
  for (int trial = 0; trial < 10; ++trial) {
    Case test(samples);
    test.s.r = {};
    test.s.subscale_r = {};
    const SolidCoefficients c{0.0, inv_kappa, tau};
    const auto before = solid_up_residual(test.T, test.s, law, c);
    const Mat3 Q = samples.rotation();
    for (int a = 0; a < 4; ++a) test.s.d[a] = Q * (test.x[a] + test.s.d[a]) - test.x[a];
    const auto after = solid_up_residual(test.T, test.s, law, c);
    Deviation of_u, of_p;
    for (int a = 0; a < 4; ++a) {
      const Vec3 expected = Q * before.u[a];
      for (int i = 0; i < 3; ++i) of_u.add(after.u[a][i], expected[i]);
      of_p.add(after.p[a], before.p[a]);
    }
    TEST_COMPARE(of_u.relative(), <, 1e-12);
    TEST_COMPARE(of_p.relative(), <, 1e-12);
  }
}

// The same with fibres: some elements have them stretched, some compressed.

const materials::Holzapfel artery({1.0, 0.2}, {3.0, 0.8, 35.0, 0.1});

oracle::HolzapfelEnergy artery_energy(const materials::Frame& frame) {
  return {1.0, 0.2, 3.0, 0.8, 35.0, 0.1, frame};
}

TEUCHOS_UNIT_TEST(SolidUp, residual_and_jacobian_with_fibres_are_those_of_the_potential) {
  Samples samples(17);
  for (int trial = 0; trial < 10; ++trial) {
    const Case test(samples);
    const materials::Frame frame = oracle::random_frame(samples);
    const SolidCoefficients c{alpha, inv_kappa, 0.0};
    const auto form = test.weak_form(artery_energy(frame), c);
    const auto Pi = form.potential(test.unknowns<oracle::First<16>>());
    kernels::MixedResidual R;
    kernels::MixedJacobian K;
    solid_up_jacobian(test.T, test.s, {artery, frame}, c, R, K);
    const auto alone = solid_up_residual(test.T, test.s, {artery, frame}, c);
    Deviation of_u, of_p, of_alone;
    for (int a = 0; a < 4; ++a) {
      for (int i = 0; i < 3; ++i) of_u.add(R.u[a][i], Pi.dx(3 * a + i));
      for (int i = 0; i < 3; ++i) of_alone.add(alone.u[a][i], Pi.dx(3 * a + i));
      of_p.add(R.p[a], Pi.dx(12 + a));
    }
    TEST_COMPARE(of_u.relative(), <, 1e-12);
    TEST_COMPARE(of_alone.relative(), <, 1e-12);
    TEST_COMPARE(of_p.relative(), <, 1e-12);
    TEST_COMPARE(jacobian_deviation(test, form, K), <, 1e-12);
  }
}

TEUCHOS_UNIT_TEST(SolidUp, force_of_fibres_rotates_with_the_body) {
  Samples samples(18);
  for (int trial = 0; trial < 10; ++trial) {
    Case test(samples);
    test.s.r = {};
    test.s.subscale_r = {};
    const materials::Frame frame = oracle::random_frame(samples);
    const SolidCoefficients c{0.0, inv_kappa, tau};
    const auto before = solid_up_residual(test.T, test.s, {artery, frame}, c);
    const Mat3 Q = samples.rotation();
    for (int a = 0; a < 4; ++a) test.s.d[a] = Q * (test.x[a] + test.s.d[a]) - test.x[a];
    const auto after = solid_up_residual(test.T, test.s, {artery, frame}, c);
    Deviation of_u;
    for (int a = 0; a < 4; ++a) {
      const Vec3 expected = Q * before.u[a];
      for (int i = 0; i < 3; ++i) of_u.add(after.u[a][i], expected[i]);
    }
    TEST_COMPARE(of_u.relative(), <, 1e-12);
  }
}

}  // namespace
