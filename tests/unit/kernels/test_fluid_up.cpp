#include <Teuchos_UnitTestHarness.hpp>

#include "oracle/fluid_weak_form.hpp"
#include "oracle/samples.hpp"
#include "tunica/kernels/energy.hpp"
#include "tunica/kernels/fluid_tau.hpp"
#include "tunica/kernels/fluid_up.hpp"
#include "tunica/materials/carreau_yasuda.hpp"
#include "tunica/materials/newtonian.hpp"

namespace {

using namespace tunica;
using kernels::FluidCoefficients;
using kernels::FluidState;
using oracle::Deviation;
using oracle::Samples;

/// What the oracle knows of a law: Newtonian with a power of 1.
struct Law {
  oracle::Thinning constants;
  materials::CarreauYasuda thinning{{constants.at_rest, constants.at_high_rates, constants.time,
                                     constants.power, constants.sharpness}};
  materials::Newtonian newtonian{constants.at_high_rates};

  const materials::ViscosityLaw* get() const {
    if (constants.power == 1.0) return &newtonian;
    return &thinning;
  }
};

Law constant(double viscosity) { return {{viscosity, viscosity, 0.0, 1.0, 2.0}}; }

const Law thin = constant(3.5e-3), thick = constant(0.5), medium = constant(0.1),
          low = constant(0.05), none = constant(0.0);
const Law carreau{{0.4, 0.03, 0.7, 0.35, 2.0}}, yasuda{{0.3, 0.02, 1.3, 0.2, 1.25}};

const FluidCoefficients blood{1.06, thin.get(), 8.0};

struct Variant {
  const Law* law;
  FluidCoefficients c;
};
const Variant variants[] = {{&thin, blood},
                            {&thin, {1.0, thin.get(), 0.0}},
                            {&thick, {1.3, thick.get(), 8.0}},
                            {&medium, {1.2, medium.get(), 8.0, 4.0, false, true}},
                            {&low, {1.1, low.get(), 8.0, 4.0, false, false, true}},
                            {&carreau, {1.1, carreau.get(), 8.0}},
                            {&yasuda, {0.9, yasuda.get(), 3.0, 4.0, false, true}}};

/// With the viscosity of the law at high rates.
double tau_at(const kernels::Tet4& T, const Vec3& velocity, const FluidCoefficients& c) {
  return fluid_tau(T, velocity, c.viscosity->reference(), c);
}

/// Of the past through the centroid.
Vec3 flow_through(const FluidState& s) {
  Vec3 c{};
  for (int a = 0; a < 4; ++a) c += 0.25 * (s.u_old[a] - s.w[a]);
  return c;
}

struct Case {
  std::array<Vec3, 4> x;
  kernels::Tet4 T;
  FluidState s;

  explicit Case(Samples& samples) : x(samples.tetrahedron()), T(kernels::make_tet4(x)) {
    s.u = samples.vectors(2.0);
    s.p = samples.numbers(2.0);
    s.u_old = samples.vectors(2.0);
    s.w = samples.vectors(0.5);
    s.f = samples.vectors(3.0);
    s.subscale = samples.vector(0.7);
    s.viscous = samples.vector(1.2);
    s.on_wall = {1.0, 0.0, 1.0, 1.0};
  }

  oracle::FluidWeakForm weak_form(const FluidCoefficients& c, const oracle::Thinning& law,
                                  double tau) const {
    return {oracle::Element(x),
            c.density,
            law,
            c.inv_dt,
            tau,
            s.u_old,
            s.w,
            s.f,
            s.subscale,
            s.viscous,
            s.on_wall,
            c.has_skew_convection,
            c.has_mean_residual};
  }

  template <class S>
  std::array<S, 16> unknowns() const {
    std::array<S, 16> y;
    for (int a = 0; a < 4; ++a) {
      for (int i = 0; i < 3; ++i) oracle::seed(y[3 * a + i], 3 * a + i, s.u[a][i]);
      oracle::seed(y[12 + a], 12 + a, s.p[a]);
    }
    return y;
  }
};

TEUCHOS_UNIT_TEST(FluidUp, residual_is_that_of_the_weak_form) {
  Samples samples(21);
  for (const auto& [law, c] : variants)
    for (int trial = 0; trial < 5; ++trial) {
      const Case test(samples);
      const double tau = tau_at(test.T, flow_through(test.s), c);
      const auto expected =
          test.weak_form(c, law->constants, tau).residual(test.unknowns<double>());
      const auto R = fluid_up_residual(test.T, test.s, c, tau);
      Deviation of_u, of_p;
      for (int a = 0; a < 4; ++a) {
        for (int i = 0; i < 3; ++i) of_u.add(R.u[a][i], expected[3 * a + i]);
        of_p.add(R.p[a], expected[12 + a]);
      }
      TEST_COMPARE(of_u.relative(), <, 1e-12);
      TEST_COMPARE(of_p.relative(), <, 1e-12);
    }
}

TEUCHOS_UNIT_TEST(FluidUp, jacobian_is_derivative_of_residual) {
  Samples samples(22);
  for (const auto& [law, c] : variants)
    for (int trial = 0; trial < 5; ++trial) {
      const Case test(samples);
      const double tau = tau_at(test.T, flow_through(test.s), c);
      const auto expected =
          test.weak_form(c, law->constants, tau).residual(test.unknowns<oracle::First<16>>());
      kernels::MixedResidual R;
      kernels::MixedJacobian K;
      fluid_up_jacobian(test.T, test.s, c, tau, R, K);
      Deviation A, B1T, B2, mC, of_R;
      for (int a = 0; a < 4; ++a) {
        of_R.add(R.p[a], expected[12 + a].val());
        for (int i = 0; i < 3; ++i) of_R.add(R.u[a][i], expected[3 * a + i].val());
        for (int b = 0; b < 4; ++b) {
          mC.add(K.mC[a][b], expected[12 + a].dx(12 + b));
          for (int i = 0; i < 3; ++i) {
            B1T.add(K.B1T[a][b][i], expected[3 * a + i].dx(12 + b));
            B2.add(K.B2[a][b][i], expected[12 + a].dx(3 * b + i));
            for (int j = 0; j < 3; ++j) A.add(K.A[a][b][i][j], expected[3 * a + i].dx(3 * b + j));
          }
        }
      }
      TEST_COMPARE(of_R.relative(), <, 1e-12);
      TEST_COMPARE(A.relative(), <, 1e-12);
      TEST_COMPARE(B1T.relative(), <, 1e-12);
      TEST_COMPARE(B2.relative(), <, 1e-12);
      TEST_COMPARE(mC.relative(), <, 1e-12);
    }
}

/// τ by its definition, for any scalar type.
template <class S>
S tau_of(const S& volume, const oracle::Vec<S>& velocity, const FluidCoefficients& c) {
  using std::pow;
  using std::sqrt;
  const S h = pow(6.0 * std::sqrt(2.0) * volume, 1.0 / 3.0);
  S speed2 = 0.0;
  for (int i = 0; i < 3; ++i) speed2 += velocity[i] * velocity[i];
  const S diffusive = c.viscous_factor * c.viscosity->reference() / (c.density * h * h);
  const S slow = 4.0 * speed2 / (h * h) + diffusive * diffusive;
  if (c.has_dynamic_subscales) return 1.0 / (c.inv_dt + sqrt(slow));
  return 1.0 / sqrt(4.0 * c.inv_dt * c.inv_dt + slow);
}

TEUCHOS_UNIT_TEST(FluidUp, shape_jacobian_is_derivative_with_respect_to_the_vertices) {
  using Fad = oracle::First<12>;
  Samples samples(27);
  for (const auto& [law, coefficients] : variants)
    for (const bool is_dynamic : {false, true})
      for (int trial = 0; trial < 5; ++trial) {
        FluidCoefficients c = coefficients;
        c.has_dynamic_subscales = is_dynamic;
        const Case test(samples);
        std::array<oracle::Vec<Fad>, 4> x, w;
        for (int a = 0; a < 4; ++a)
          for (int i = 0; i < 3; ++i) {
            oracle::seed(x[a][i], 3 * a + i, test.x[a][i]);
            w[a][i] = test.s.w[a][i] + c.inv_dt * (x[a][i] - test.x[a][i]);
          }
        const oracle::ElementOf<Fad> T(x);
        oracle::Vec<Fad> velocity;
        for (int i = 0; i < 3; ++i) {
          velocity[i] = 0.0;
          for (int a = 0; a < 4; ++a) velocity[i] += 0.25 * (test.s.u_old[a][i] - w[a][i]);
        }
        const Fad tau = tau_of(T.volume, velocity, c);
        const oracle::FluidWeakFormOn<Fad> form{T,
                                                c.density,
                                                law->constants,
                                                c.inv_dt,
                                                tau,
                                                test.s.u_old,
                                                w,
                                                test.s.f,
                                                test.s.subscale,
                                                test.s.viscous,
                                                test.s.on_wall,
                                                c.has_skew_convection,
                                                c.has_mean_residual};
        std::array<Fad, 16> unknowns;
        for (int a = 0; a < 4; ++a) {
          for (int i = 0; i < 3; ++i) unknowns[3 * a + i] = test.s.u[a][i];
          unknowns[12 + a] = test.s.p[a];
        }
        const auto expected = form.residual(unknowns);
        TEST_FLOATING_EQUALITY(tau.val(), tau_at(test.T, flow_through(test.s), c), 1e-13);
        kernels::ShapeJacobian K;
        fluid_up_shape_jacobian(
            test.T, test.s, c, tau.val(),
            fluid_tau_derivative(test.T, flow_through(test.s), c.viscosity->reference(), c), K);
        Deviation of_u, of_p;
        for (int a = 0; a < 4; ++a)
          for (int b = 0; b < 4; ++b)
            for (int j = 0; j < 3; ++j) {
              of_p.add(K.p[a][b][j], expected[12 + a].dx(3 * b + j));
              for (int i = 0; i < 3; ++i)
                of_u.add(K.u[a][b][i][j], expected[3 * a + i].dx(3 * b + j));
            }
        TEST_COMPARE(of_u.relative(), <, 1e-11);
        TEST_COMPARE(of_p.relative(), <, 1e-11);
      }
}

TEUCHOS_UNIT_TEST(FluidUp, skew_convection_balances_the_energy_of_divergence) {
  // what it adds to the rows, times u, is −(−½ρ ∫ |u|² div u) of the advective form
  Samples samples(28);
  FluidCoefficients skew = blood;
  skew.has_skew_convection = true;
  for (int trial = 0; trial < 5; ++trial) {
    const Case test(samples);
    const auto with = fluid_up_residual(test.T, test.s, skew, 0.01);
    const auto without = fluid_up_residual(test.T, test.s, blood, 0.01);
    double power = 0.0;
    for (int a = 0; a < 4; ++a) power += dot(with.u[a] - without.u[a], test.s.u[a]);
    TEST_FLOATING_EQUALITY(power, kernels::power_of_divergence(test.T, test.s.u, blood.density),
                           1e-12);
  }
}

TEUCHOS_UNIT_TEST(FluidUp, uniform_flow_on_a_moving_mesh_has_no_residual) {
  Samples samples(23);
  for (int trial = 0; trial < 10; ++trial) {
    Case test(samples);
    const Vec3 uniform = samples.vector(2.0);
    test.s.u = test.s.u_old = {uniform, uniform, uniform, uniform};
    test.s.p = {0, 0, 0, 0};
    test.s.f = {};
    test.s.subscale = test.s.viscous = {};
    const double tau = tau_at(test.T, flow_through(test.s), blood);
    const auto R = fluid_up_residual(test.T, test.s, blood, tau);
    for (int a = 0; a < 4; ++a) {
      TEST_COMPARE(norm(R.u[a]), <, 1e-15);
      TEST_COMPARE(std::abs(R.p[a]), <, 1e-15);
    }
  }
}

TEUCHOS_UNIT_TEST(FluidUp, rigid_rotation_meets_no_viscous_force) {
  Samples samples(24);
  Case test(samples);
  const Vec3 spin = samples.vector(2.0);
  for (int a = 0; a < 4; ++a) test.s.u[a] = cross(spin, test.x[a]);
  test.s.w = test.s.u_old = test.s.u;  // no convection, no acceleration
  test.s.p = {0, 0, 0, 0};
  test.s.f = {};
  test.s.subscale = test.s.viscous = {};
  const auto R = fluid_up_residual(test.T, test.s, {1.0, thick.get(), 8.0}, 0.05);
  for (int a = 0; a < 4; ++a) {
    TEST_COMPARE(norm(R.u[a]), <, 1e-14);
    TEST_COMPARE(std::abs(R.p[a]), <, 1e-14);
  }
}

TEUCHOS_UNIT_TEST(FluidUp, tau_tends_to_its_three_limits) {
  Samples samples(25);
  Case test(samples);
  const double h = kernels::element_length(test.T.volume);
  const Vec3 c{3, 0, 4};
  test.s.u_old = {c, c, c, c};
  test.s.w = {};
  TEST_FLOATING_EQUALITY(tau_at(test.T, flow_through(test.s), {1.0, none.get(), 1e6}), 5e-7, 1e-8);
  TEST_FLOATING_EQUALITY(tau_at(test.T, flow_through(test.s), {1.0, none.get(), 0.0}), h / 10.0,
                         1e-13);
  test.s.w = test.s.u_old;
  TEST_FLOATING_EQUALITY(tau_at(test.T, flow_through(test.s), {2.0, thick.get(), 0.0}), h * h,
                         1e-13);
}

TEUCHOS_UNIT_TEST(FluidUp, dynamic_subscales_solve_their_own_equation) {
  // ρ (u' − ũ')/Δt + ρ u'/τ_s = −r with the mean residual r, τ_s that of steady flow
  Samples samples(26);
  FluidCoefficients c = blood, steady = blood;
  c.has_dynamic_subscales = true;
  steady.inv_dt = 0.0;
  for (int trial = 0; trial < 5; ++trial) {
    const Case test(samples);
    const double tau_s = tau_at(test.T, flow_through(test.s), steady);
    const Vec3 u = fluid_subscale(test.T, test.s, c, tau_at(test.T, flow_through(test.s), c));
    Mat3 G{};
    Vec3 r = -1.0 * test.s.viscous;
    for (int a = 0; a < 4; ++a) {
      r += test.s.p[a] * test.T.grad_N[a];
      for (int i = 0; i < 3; ++i)
        for (int j = 0; j < 3; ++j) G[i][j] += test.s.u[a][i] * test.T.grad_N[a][j];
    }
    for (int a = 0; a < 4; ++a)
      r += 0.25 * c.density *
           (c.inv_dt * (test.s.u[a] - test.s.u_old[a]) + G * (test.s.u[a] - test.s.w[a]) -
            test.s.f[a]);
    for (int i = 0; i < 3; ++i)
      TEST_FLOATING_EQUALITY(c.density * ((u[i] - test.s.subscale[i]) * c.inv_dt + u[i] / tau_s),
                             -r[i], 1e-11);
  }
}

}  // namespace
