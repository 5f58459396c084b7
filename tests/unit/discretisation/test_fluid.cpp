#include <Teuchos_UnitTestHarness.hpp>
#include <cmath>

#include "oracle/fluid_weak_form.hpp"
#include "tunica/discretisation/fluid.hpp"
#include "tunica/kernels/tet4.hpp"
#include "unit/discretisation/few_tets.hpp"

namespace {

using namespace tunica;
using discretisation::Fluid;
using test::ElementValues;
using test::FewTets;

constexpr double density = 1.06, viscosity = 0.05, step = 0.5;

Teuchos::ParameterList fluid_list(const std::string& convection = "advective") {
  Teuchos::ParameterList list = test::fluid_list(density, viscosity);
  list.set("regions", Teuchos::Array<std::string>(std::vector<std::string>{"block"}));
  list.set<std::string>("time scheme", "implicit euler")
      .set<std::string>("stabilisation", "inertial")
      .set<std::string>("stabilisation residual", "linear")
      .set<std::string>("stabilisation velocity", "past")
      .set<std::string>("convection", convection);
  return list;
}

Fluid make_fluid(const Teuchos::ParameterList& list, const fields::FieldMesh& mesh) {
  return Fluid(discretisation::fluid_options(test::resolved(list, problems::fluid_table())), mesh);
}

/// A displacement of all local nodes without pattern.
std::vector<Vec3> shaken(const fields::FieldMesh& mesh, int seed, double size) {
  std::vector<Vec3> d;
  for (const int vertex : mesh.vertex)
    d.push_back(size * Vec3{test::scatter(4.0 * vertex + seed),
                            test::scatter(4.0 * vertex + 1 + seed),
                            test::scatter(4.0 * vertex + 2 + seed)});
  return d;
}

/// The weak form of an element in the step from u_old, on the mesh at x with the velocity w:
/// τ = (4/Δt² + (2 |c|/h)² + (4 ν/h²)²)^(−½), c the past velocity through the centroid.
oracle::FluidWeakForm weak_form(const std::array<Vec3, 4>& x, const std::array<Vec3, 4>& u_old,
                                const std::array<Vec3, 4>& w, bool is_skew) {
  Vec3 c{};
  for (int a = 0; a < 4; ++a) c += 0.25 * (u_old[a] - w[a]);
  const double h = kernels::element_length(kernels::make_tet4(x).volume);
  const double diffusive = 4.0 * viscosity / density / (h * h);
  const double tau =
      1.0 / std::sqrt(4.0 / (step * step) + 4.0 * dot(c, c) / (h * h) + diffusive * diffusive);
  const oracle::Thinning newtonian{viscosity, viscosity, 0.0, 1.0, 2.0};
  return {
      oracle::Element(x), density, newtonian, 1.0 / step, tau, u_old, w, {}, {}, {}, {}, is_skew};
}

void compare_with_weak_form(bool is_skew, Teuchos::FancyOStream& out, bool& success) {
  const FewTets few;
  const fields::FieldMesh& mesh = few.field;
  Fluid fluid = make_fluid(fluid_list(is_skew ? "skew-symmetric" : "advective"), mesh);
  const algebra::BlockVector past = test::scattered(mesh, 2);
  fluid.start_from(past);
  fluid.begin_step(stepping::Clock(step, 1));
  const std::vector<Vec3> d = shaken(mesh, 7, 0.03), d_past = shaken(mesh, 9, 0.03);
  TEST_ASSERT(fluid.set_domain(d, d_past).is_success());
  algebra::BlockVector x = test::scattered(mesh, 3), F(fluid.space()), Kv(fluid.space());
  const algebra::BlockVector v = test::scattered(mesh, 5);
  fluid.prescribe(x);
  TEST_ASSERT(fluid.residual(x, F).is_success());

  const std::vector<ElementValues> values = test::element_values(mesh, x),
                                   before = test::element_values(mesh, past);
  const auto rows = [&](std::size_t e) {
    std::array<Vec3, 4> at, u_old, w;
    std::array<oracle::First<16>, 16> y;
    for (int a = 0; a < 4; ++a) {
      const int node = mesh.tets[e][a];
      at[a] = mesh.x[node] + d[node];
      w[a] = 1.0 / step * (d[node] - d_past[node]);
      u_old[a] = {before[e][3 * a], before[e][3 * a + 1], before[e][3 * a + 2]};
    }
    for (int k = 0; k < 16; ++k) oracle::seed(y[k], k, values[e][k]);
    return weak_form(at, u_old, w, is_skew).residual(y);
  };
  const algebra::BlockVector expected = test::residual_by_values(mesh, fluid.space(), rows);
  TEST_COMPARE(test::relative_difference(F, expected), <, 1e-12);
  fluid.assemble_jacobian(x);
  fluid.jacobian().apply(v, Kv);
  TEST_COMPARE(test::relative_difference(Kv, test::product_by_derivatives(mesh, v, rows)), <,
               1e-12);
}

TEUCHOS_UNIT_TEST(Fluid, residual_and_jacobian_on_a_mesh_that_moves_are_those_of_the_weak_form) {
  compare_with_weak_form(false, out, success);
}

TEUCHOS_UNIT_TEST(Fluid, so_they_are_where_convection_is_skew_symmetric) {
  compare_with_weak_form(true, out, success);
}

constexpr double rate = 0.8;  // of u = γ z e_x, above a bottom that sticks

Vec3 linear_flow(const Vec3& x, double) { return {rate * x[2], 0.0, 0.0}; }

algebra::BlockVector linear_state(const Fluid& fluid, double gradient) {
  return test::interpolated(
      fluid.mesh(), fluid.space(), [](const Vec3& x) { return linear_flow(x, 0.0); },
      [=](const Vec3& x) { return gradient * x[0]; });
}

TEUCHOS_UNIT_TEST(Fluid, sums_over_a_linear_flow_are_known) {
  const FewTets few;
  Fluid fluid = make_fluid(fluid_list(), few.field);
  algebra::BlockVector x = linear_state(fluid, 3.0);
  fluid.begin_step(stepping::Clock(step, 1));
  fluid.prescribe(x);
  // ρ/2 ∫ γ² z² dV,  z from 0 to 0.4
  TEST_FLOATING_EQUALITY(test::observed(fluid.observe(x), "fluid_kinetic_energy_kPa_mm3"),
                         0.5 * density * rate * rate * 0.6 * 0.3 * std::pow(0.4, 3) / 3.0, 1e-12);
  const int side = few.field.surface_index("x_high");
  const discretisation::Observables of_side = fluid.observe_surfaces(x, {side});
  TEST_FLOATING_EQUALITY(test::observed(of_side, "area_x_high_mm2"), 0.3 * 0.4, 1e-12);
  TEST_FLOATING_EQUALITY(test::observed(of_side, "mean_pressure_x_high_kPa"), 3.0 * 0.6, 1e-12);
  TEST_FLOATING_EQUALITY(test::observed(of_side, "inflow_x_high_mm3_per_ms"),
                         -rate * 0.3 * 0.4 * 0.4 / 2.0, 1e-12);
}

TEUCHOS_UNIT_TEST(Fluid, the_shear_stress_of_a_linear_flow_is_that_of_newton) {
  const FewTets few;
  Teuchos::ParameterList list = fluid_list();
  test::condition(list, "z_low", "no slip");
  for (const char* surface : {"x_low", "x_high", "y_low", "y_high", "z_high"})
    test::set_vector(test::condition(list, surface, "velocity"), "velocity", {1.0, 0.0, 0.0});
  Fluid fluid = make_fluid(list, few.field);
  fluid.set_boundary_velocity(linear_flow);
  algebra::BlockVector x = linear_state(fluid, 0.0);
  fluid.start_from(x);
  fluid.begin_step(stepping::Clock(step, 1));
  fluid.prescribe(x);
  const std::vector<Vec3> stress = fluid.wall_shear_stress(x);
  const int low = few.field.surface_index("z_low");
  for (int a = 0; a < few.field.n_owned; ++a) {
    const Vec3 expected{few.field.is_on(a, low) ? viscosity * rate : 0.0, 0.0, 0.0};
    TEST_COMPARE(norm(stress[a] - expected), <, 1e-13);
  }
}

}  // namespace
