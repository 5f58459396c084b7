// Flows that linear elements hold exactly, on meshes that move at random:
//
//   u = U                            uniform, no body force, p constant
//   u = A x, tr A = 0, p = g·x       f = A A x + g/ρ
//
// Along a moving vertex (u − ũ)/Δt = A (x − x̃)/Δt = A w, whatever past x̃ a time scheme makes, which
// the convection with u − w takes back: the second flow is exact only if w enters with the right
// sign and size, and if mesh and fluid have the same scheme.

#include <Teuchos_UnitTestHarness.hpp>
#include <random>

#include "fluid_on_cube.hpp"
#include "tunica/base/error.hpp"

namespace {

using namespace tunica;

constexpr double density = 1.3, viscosity = 0.02, step = 0.1;
constexpr Vec3 U{1.0, -0.7, 0.4}, g{0.3, -0.2, 0.5};
constexpr Mat3 A{{{0.4, 1.1, -0.3}, {0.2, -0.9, 0.7}, {-0.6, 0.8, 0.5}}};

/// Displacement of the nodes at a step: smooth, plus random by a tenth of a cell. The random
/// part depends on the vertex, not on the rank.
std::vector<Vec3> motion(const fields::FieldMesh& mesh, int at_step, double cell) {
  std::vector<Vec3> d(mesh.n_nodes());
  for (int a = 0; a < mesh.n_nodes(); ++a) {
    std::mt19937 random(1000 * mesh.vertex[a] + at_step);
    std::uniform_real_distribution<double> part(-0.1 * cell, 0.1 * cell);
    const Vec3& x = mesh.x[a];
    for (int i = 0; i < 3; ++i)
      d[a][i] = 0.1 * std::sin(3.0 * x[(i + 1) % 3] + 0.8 * at_step) + part(random);
  }
  return d;
}

struct Worst {
  double u = 0.0, p = 0.0;
};

/// Largest nodal errors over four steps, the pressure's up to a constant.
Worst worst_of(problems::FluidProblem& fluid, const boundary::VectorField& u, const Vec3& grad_p) {
  const fields::FieldMesh& mesh = fluid.mesh();
  Worst worst;
  stepping::Timeline past = verify::mesh_at_rest(fluid);
  for (stepping::Clock clock(step, 4); !clock.is_done(); clock.advance()) {
    const std::vector<Vec3> d = motion(mesh, clock.step(), 0.25);
    verify::solve_moving_step(fluid, clock, d, past);
    const auto u_h = fields::ghosted_vectors(mesh, fluid.state()[0]);
    const auto p_h = fields::ghosted_scalars(mesh, fluid.state()[1]);
    const auto offset = [&](int a) { return p_h[a] - dot(grad_p, fluid.field().positions()[a]); };
    const double constant = verify::mean_over_nodes(mesh, offset);
    for (int a = 0; a < mesh.n_owned; ++a) {
      const Vec3 exact = u(fluid.field().positions()[a], clock.time());
      worst.u = std::max(worst.u, norm(u_h[a] - exact));
      worst.p = std::max(worst.p, std::abs(offset(a) - constant));
    }
  }
  worst.u = global_max(*mesh.comm, worst.u);
  worst.p = global_max(*mesh.comm, worst.p);
  return worst;
}

constexpr const char* schemes[] = {"implicit euler", "bdf2"};

Teuchos::ParameterList options(const std::string& scheme) {
  using verify::entry;
  return verify::enclosed_fluid(density, viscosity,
                                entry("relative increment", "double", "1e-13") +
                                    entry("absolute increment", "double", "1e-13") +
                                    entry("linear tolerance", "double", "1e-10"),
                                scheme, "dynamic");
}

TEUCHOS_UNIT_TEST(moving_mesh, uniform_flow_stays_uniform) {
  const fields::FieldMesh field = verify::field_of(verify::make_cube(4));
  for (const char* scheme : schemes) {
    problems::FluidProblem fluid(options(scheme), field);
    fluid.set_initial_velocity([](const Vec3&) { return U; });
    const auto u = [](const Vec3&, double) { return U; };
    fluid.field().set_boundary_velocity(u);
    const Worst worst = worst_of(fluid, u, {});
    out << scheme << ": velocity " << worst.u << ", pressure " << worst.p << "\n";
    TEST_COMPARE(worst.u, <, 1e-12);
    TEST_COMPARE(worst.p, <, 1e-12);
  }
}

TEUCHOS_UNIT_TEST(moving_mesh, linear_steady_flow_is_exact) {
  const fields::FieldMesh field = verify::field_of(verify::make_cube(4));
  for (const char* scheme : schemes) {
    problems::FluidProblem fluid(options(scheme), field);
    fluid.set_initial_velocity([](const Vec3& x) { return A * x; });
    const auto u = [](const Vec3& x, double) { return A * x; };
    fluid.field().set_boundary_velocity(u);
    fluid.field().set_body_force(
        [](const Vec3& x, double) { return A * (A * x) + 1.0 / density * g; });
    const Worst worst = worst_of(fluid, u, g);
    out << scheme << ": velocity " << worst.u << ", pressure " << worst.p << "\n";
    TEST_COMPARE(worst.u, <, 1e-11);
    TEST_COMPARE(worst.p, <, 1e-11);
  }
}

}  // namespace
