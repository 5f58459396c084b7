// Flows on a domain that moves and changes its shape, with the body force that makes them exact:
//
//   harmonic   u_i = g sin(2x_{i+1}) e^{2(x_{i+2} − 1)},   p = g (cos(2x) sin(y) + z),   cyclic
//   linear     u = g A x, tr A = 0,                        p = g z
//   g = 1 + sin(ωt)/2,   div u = 0,   Δu = 0
//
// The points of the unit cube move by d_i = a sin(ωt) (sin(πX_{i+1}) + X_i/2), the boundary too.
//
// A harmonic velocity keeps the scheme consistent on linear elements, see test_manufactured.cpp;
// with Δt ~ h² the errors of space and time together are of second order in h. The linear flow
// has no error of space. What remains is that of the time scheme on a moving mesh: first order for
// implicit Euler, second for BDF2.

#include <Teuchos_UnitTestHarness.hpp>

#include "fluid_on_cube.hpp"
#include "manufactured_flow.hpp"
#include "tunica/base/error.hpp"

namespace {

using namespace tunica;
using verify::Flow;
using verify::FlowErrors;

constexpr double density = 2.0, viscosity = 0.1, omega = 3.0, amplitude = 0.08;
const double pi = std::acos(-1.0);

constexpr Mat3 A{{{0.4, 1.1, -0.3}, {0.2, -0.9, 0.7}, {-0.6, 0.8, 0.5}}};

enum class Kind { harmonic, linear };

/// With g = 1.
Flow shape_at(Kind kind, const Vec3& x) {
  Flow flow;
  flow.laplacian = {};
  if (kind == Kind::linear) {
    flow.u = A * x;
    flow.G = A;
    flow.p = x[2];
    flow.grad_p = {0.0, 0.0, 1.0};
    return flow;
  }
  for (int i = 0; i < 3; ++i) {
    const int j = (i + 1) % 3, l = (i + 2) % 3;
    const double s = std::sin(2.0 * x[j]), e = std::exp(2.0 * (x[l] - 1.0));
    flow.u[i] = s * e;
    flow.G[i][j] = 2.0 * std::cos(2.0 * x[j]) * e;
    flow.G[i][l] = 2.0 * s * e;
  }
  flow.p = std::cos(2.0 * x[0]) * std::sin(x[1]) + x[2];
  flow.grad_p = {-2.0 * std::sin(2.0 * x[0]) * std::sin(x[1]),
                 std::cos(2.0 * x[0]) * std::cos(x[1]), 1.0};
  return flow;
}

Flow flow_at(Kind kind, const Vec3& x, double time) {
  Flow flow = shape_at(kind, x);
  const double g = 1.0 + 0.5 * std::sin(omega * time);
  flow.dudt = 0.5 * omega * std::cos(omega * time) * flow.u;
  flow.u = g * flow.u;
  for (Vec3& row : flow.G) row = g * row;
  flow.p *= g;
  flow.grad_p = g * flow.grad_p;
  return flow;
}

std::vector<Vec3> motion(const fields::FieldMesh& mesh, double time) {
  std::vector<Vec3> d(mesh.n_nodes());
  for (int a = 0; a < mesh.n_nodes(); ++a)
    for (int i = 0; i < 3; ++i)
      d[a][i] = amplitude * std::sin(omega * time) *
                (std::sin(pi * mesh.x[a][(i + 1) % 3]) + 0.5 * mesh.x[a][i]);
  return d;
}

/// Runs the problem over the given steps.
void march(Kind kind, problems::FluidProblem& fluid, const stepping::Clock& times) {
  const auto u = [kind](const Vec3& x, double time) { return flow_at(kind, x, time).u; };
  fluid.set_initial_velocity([u](const Vec3& x) { return u(x, 0.0); });
  fluid.field().set_boundary_velocity(u);
  fluid.field().set_body_force([kind](const Vec3& x, double time) {
    return verify::body_force(flow_at(kind, x, time), density, viscosity);
  });
  stepping::Timeline past = verify::mesh_at_rest(fluid);
  for (stepping::Clock clock = times; !clock.is_done(); clock.advance()) {
    const std::vector<Vec3> d = motion(fluid.mesh(), clock.time());
    verify::solve_moving_step(fluid, clock, d, past);
  }
}

FlowErrors errors_on_cube(Kind kind, int n, const stepping::Clock& times, const std::string& scheme,
                          std::ostream& out) {
  const fields::FieldMesh field = verify::field_of(verify::make_cube(n));
  problems::FluidProblem fluid(verify::enclosed_fluid(density, viscosity, "", scheme, "dynamic"),
                               field);
  march(kind, fluid, times);
  const double end = times.steps() * times.step_size();
  const FlowErrors errors =
      verify::flow_errors(fluid, [&](const Vec3& x) { return flow_at(kind, x, end); });
  out << "n " << n << ", " << times.steps() << " steps: velocity " << errors.u << ", pressure "
      << errors.p << "\n";
  return errors;
}

TEUCHOS_UNIT_TEST(moving_domain, harmonic_flow_converges_at_second_and_first_order) {
  FlowErrors last{};
  int n_old = 1;
  for (const int n : {4, 6, 9}) {
    const int steps = n * n / 4;
    const FlowErrors errors = errors_on_cube(Kind::harmonic, n, stepping::Clock(0.4 / steps, steps),
                                             "implicit euler", out);
    if (n > 4) {
      TEST_COMPARE(verify::order(last.u, errors.u, double(n) / n_old), >=, 1.8);
      TEST_COMPARE(verify::order(last.p, errors.p, double(n) / n_old), >=, 1.0);
    }
    last = errors;
    n_old = n;
  }
  TEST_COMPARE(last.u, <, 8e-3);
}

TEUCHOS_UNIT_TEST(moving_domain, linear_flow_has_the_error_of_implicit_euler_alone) {
  FlowErrors last{};
  for (const int steps : {16, 32, 64}) {
    const FlowErrors errors =
        errors_on_cube(Kind::linear, 4, stepping::Clock(0.8 / steps, steps), "implicit euler", out);
    if (steps > 16) {
      TEST_FLOATING_EQUALITY(verify::order(last.u, errors.u), 1.0, 0.1);
      TEST_FLOATING_EQUALITY(verify::order(last.p, errors.p), 1.0, 0.1);
    }
    last = errors;
  }
}

TEUCHOS_UNIT_TEST(moving_domain, linear_flow_has_the_error_of_bdf2_alone) {
  FlowErrors last{};
  for (const int steps : {16, 32, 64}) {
    const FlowErrors errors =
        errors_on_cube(Kind::linear, 4, stepping::Clock(0.8 / steps, steps), "bdf2", out);
    if (steps > 16) {
      TEST_FLOATING_EQUALITY(verify::order(last.u, errors.u), 2.0, 0.1);
      TEST_COMPARE(verify::order(last.p, errors.p), >, 1.8);
    }
    last = errors;
  }
}

}  // namespace
