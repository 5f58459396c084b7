// Smooth flows on the unit cube with the body force that makes them exact:
//
//   u_i = (1 + t/2) sin(2k x_{i+1}) c(x_{i+2}),   p = cos(2x) sin(y) + z,   cyclic, div u = 0
//   f   = ∂u/∂t + (u·∇)u − ν Δu + ∇p/ρ
//
//   general    c = cos(kx),        Δu = −5k² u
//   harmonic   c = e^{2k(x−1)},    Δu = 0
//
// Implicit Euler is exact for a flow that is linear in t, so no error of time remains. The
// pressure of an enclosed fluid is known up to a constant.
//
// The viscous part −μΔu of the stabilisation's residual, which linear elements do not see, is
// recovered from the strain rates around each vertex. A harmonic flow has none, and shows what the
// recovery disturbs. Left out in general, PSPG adds τμΔu/ρ to the flux, up to h²/4 Δu: second
// order, but larger than the error of interpolation, and not second order at all while τ is Δt/2
// or h/(2|u|) instead of h²/(4ν). With Δt ~ h² below h²/(2ν), τ is Δt/2 on all meshes.

#include <Teuchos_UnitTestHarness.hpp>

#include "fluid_on_cube.hpp"
#include "manufactured_flow.hpp"
#include "tunica/base/error.hpp"

namespace {

using namespace tunica;
using verify::Flow;
using verify::FlowErrors;

constexpr double k = 1.0, density = 2.0, viscosity = 0.1;  // Re about 20

enum class Kind { general, harmonic };

Flow flow_at(Kind kind, const Vec3& x, double time) {
  Flow flow;
  const double factor = 1.0 + 0.5 * time;
  for (int i = 0; i < 3; ++i) {
    const int j = (i + 1) % 3, l = (i + 2) % 3;
    const bool is_harmonic = kind == Kind::harmonic;
    const double s = std::sin(2.0 * k * x[j]);
    const double c = is_harmonic ? std::exp(2.0 * k * (x[l] - 1.0)) : std::cos(k * x[l]);
    const double dc = is_harmonic ? 2.0 * k * c : -k * std::sin(k * x[l]);
    flow.u[i] = factor * s * c;
    flow.dudt[i] = 0.5 * s * c;
    flow.laplacian[i] = is_harmonic ? 0.0 : -5.0 * k * k * flow.u[i];
    flow.G[i][j] = factor * 2.0 * k * std::cos(2.0 * k * x[j]) * c;
    flow.G[i][l] = factor * s * dc;
  }
  flow.p = std::cos(2.0 * x[0]) * std::sin(x[1]) + x[2];
  flow.grad_p = {-2.0 * std::sin(2.0 * x[0]) * std::sin(x[1]),
                 std::cos(2.0 * x[0]) * std::cos(x[1]), 1.0};
  return flow;
}

FlowErrors errors_on_cube(Kind kind, int n, const stepping::Clock& times) {
  const fields::FieldMesh field = verify::field_of(verify::make_cube(n));
  problems::FluidProblem fluid(verify::enclosed_fluid(density, viscosity), field);
  const auto u = [kind](const Vec3& x, double time) { return flow_at(kind, x, time).u; };
  fluid.set_initial_velocity([u](const Vec3& x) { return u(x, 0.0); });
  fluid.field().set_boundary_velocity(u);
  fluid.field().set_body_force([kind](const Vec3& x, double time) {
    return verify::body_force(flow_at(kind, x, time), density, viscosity);
  });
  for (stepping::Clock clock = times; !clock.is_done(); clock.advance()) {
    fluid.begin_step(clock);
    const nonlinear::NewtonReport report = fluid.solve();
    TUNICA_CHECK(report.is_converged, report.reason);
    fluid.end_step();
  }
  const double end = times.steps() * times.step_size();
  return verify::flow_errors(fluid, [kind, end](const Vec3& x) { return flow_at(kind, x, end); });
}

/// Checks the orders between the last errors (none: zeros) and those on cells smaller by the
/// factor.
void compare(const FlowErrors& last, const FlowErrors& e, double factor, Teuchos::FancyOStream& out,
             bool& success) {
  out << "velocity " << e.u << ", pressure " << e.p << "\n";
  if (last.u == 0.0) return;
  TEST_COMPARE(verify::order(last.u, e.u, factor), >=, 1.9);
  TEST_COMPARE(verify::order(last.p, e.p, factor), >=, 1.5);
}

TEUCHOS_UNIT_TEST(manufactured_flow, harmonic_flow_converges_at_second_order) {
  FlowErrors last{};
  int n_old = 1;
  for (const int n : {6, 9, 12}) {
    const FlowErrors error = errors_on_cube(Kind::harmonic, n, stepping::Clock(0.5, 2));
    compare(last, error, double(n) / n_old, out, success);
    last = error;
    n_old = n;
  }
  TEST_COMPARE(last.u, <, 5e-3);
}

TEUCHOS_UNIT_TEST(manufactured_flow, general_flow_converges_at_second_order) {
  FlowErrors last{};
  int n_old = 1;
  for (const int n : {6, 9, 12}) {
    const int steps = n * n / 9;
    const FlowErrors error = errors_on_cube(Kind::general, n, stepping::Clock(0.1 / steps, steps));
    compare(last, error, double(n) / n_old, out, success);
    last = error;
    n_old = n;
  }
  TEST_COMPARE(last.u, <, 1e-2);
}

}  // namespace
