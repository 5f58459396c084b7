// A smooth flow on the unit cube with the body force that makes it exact:
//
//   u_i = (1 + t/2) sin(2k x_{i+1}) cos(k x_{i+2}),   p = cos(2x) sin(y) + z,   cyclic, div u = 0
//   f   = ∂u/∂t + (u·∇)u − ν Δu + ∇p/ρ,               Δu = −5k² u
//
// Implicit Euler is exact for a flow that is linear in t, so no error of time remains. The
// pressure of an enclosed fluid is known up to a constant.

#include <Teuchos_UnitTestHarness.hpp>

#include "assembly/gather.hpp"
#include "base/error.hpp"
#include "fluid_on_cube.hpp"
#include "oracle/quadrature.hpp"

namespace {

using namespace tunica;

constexpr double k = 1.5, density = 2.0, viscosity = 0.1;  // Re = 20

struct Flow {
  Vec3 u, dudt, laplacian, grad_p;
  Mat3 G{};
  double p;
};

Flow flow_at(const Vec3& x, double time) {
  Flow flow;
  const double factor = 1.0 + 0.5 * time;
  for (int i = 0; i < 3; ++i) {
    const int j = (i + 1) % 3, l = (i + 2) % 3;
    const double s = std::sin(2.0 * k * x[j]), c = std::cos(k * x[l]);
    flow.u[i] = factor * s * c;
    flow.dudt[i] = 0.5 * s * c;
    flow.laplacian[i] = -5.0 * k * k * flow.u[i];
    flow.G[i][j] = factor * 2.0 * k * std::cos(2.0 * k * x[j]) * c;
    flow.G[i][l] = -factor * k * s * std::sin(k * x[l]);
  }
  flow.p = std::cos(2.0 * x[0]) * std::sin(x[1]) + x[2];
  flow.grad_p = {-2.0 * std::sin(2.0 * x[0]) * std::sin(x[1]),
                 std::cos(2.0 * x[0]) * std::cos(x[1]), 1.0};
  return flow;
}

Vec3 body_force(const Vec3& x, double time) {
  const Flow flow = flow_at(x, time);
  return flow.dudt + flow.G * flow.u - viscosity / density * flow.laplacian +
         1.0 / density * flow.grad_p;
}

struct Errors {
  double u, p;
};

/// L2 norms over the cube of volume one; the mean of the pressure's error is taken out.
Errors errors_of(const problems::FluidProblem& fluid, double time) {
  const fields::FieldMesh& mesh = fluid.mesh();
  const auto u = fields::ghosted_vectors(mesh, *fluid.state().u);
  const auto p = fields::ghosted_scalars(mesh, *fluid.state().p);
  double u2 = 0.0, p1 = 0.0, p2 = 0.0;
  for (std::size_t e = 0; e < mesh.tets.size(); ++e) {
    if (!mesh.is_counted[e]) continue;
    for (const oracle::TetPoint& point : oracle::tet_rule()) {
      Vec3 x{}, u_h{};
      double p_h = 0.0;
      for (int a = 0; a < 4; ++a) {
        const int node = mesh.tets[e][a];
        x += point.N[a] * mesh.x[node];
        u_h += point.N[a] * u[node];
        p_h += point.N[a] * p[node];
      }
      const Flow flow = flow_at(x, time);
      const double dV = point.weight * fluid.elements().geometry[e].volume;
      u2 += dV * dot(u_h - flow.u, u_h - flow.u);
      p1 += dV * (p_h - flow.p);
      p2 += dV * (p_h - flow.p) * (p_h - flow.p);
    }
  }
  const auto sum = [&mesh](double mine) { return fields::global_sum(*mesh.comm, mine); };
  p1 = sum(p1);
  return {std::sqrt(sum(u2)), std::sqrt(sum(p2) - p1 * p1)};
}

Errors errors_on_cube(int n) {
  const fields::FieldMesh field = verify::field_of(verify::make_cube(n));
  problems::FluidProblem fluid(verify::enclosed_fluid(density, viscosity), field);
  fluid.set_initial_velocity([](const Vec3& x) { return flow_at(x, 0.0).u; });
  fluid.set_boundary_velocity([](const Vec3& x, double time) { return flow_at(x, time).u; });
  fluid.set_body_force(body_force);
  stepping::Clock clock(0.5, 2);
  for (; !clock.is_done(); clock.advance()) {
    fluid.begin_step(clock);
    const nonlinear::NewtonReport report = fluid.solve();
    TUNICA_CHECK(report.is_converged, report.reason);
  }
  return errors_of(fluid, 1.0);
}

TEUCHOS_UNIT_TEST(manufactured_flow, velocity_and_pressure_converge_at_their_orders) {
  Errors last{};
  for (const int n : {4, 8, 16}) {
    const Errors error = errors_on_cube(n);
    out << "n " << n << ": velocity " << error.u << " order " << verify::order(last.u, error.u)
        << ", pressure " << error.p << " order " << verify::order(last.p, error.p) << "\n";
    if (n > 4) {
      TEST_COMPARE(verify::order(last.u, error.u), >=, 1.9);
      TEST_COMPARE(verify::order(last.p, error.p), >=, 1.0);
    }
    last = error;
  }
  TEST_COMPARE(last.u, <, 1e-2);
}

}  // namespace
