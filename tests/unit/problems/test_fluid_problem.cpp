#include <Teuchos_UnitTestHarness.hpp>

#include "tunica/assembly/gather.hpp"
#include "tunica/base/error.hpp"
#include "tunica/boundary/surface_geometry.hpp"
#include "tunica/discretisation/inverted_element.hpp"
#include "tunica/kernels/surface_tri3.hpp"
#include "tunica/problems/fluid_problem.hpp"
#include "unit/problems/lists.hpp"

namespace {

using namespace tunica;
using problems::FluidProblem;
using test::SmallTube;

/// Open inlet and outlet with backflow stabilisation, moving interface.
Teuchos::ParameterList open_tube() {
  auto list = test::fluid_list(1.0, 3.5e-3);
  auto& inlet = test::condition(list, "inlet", "pressure");
  inlet.set("pressure", 1.3);
  inlet.set("backflow stabilisation", 0.5);
  auto& outlet = test::condition(list, "outlet", "traction");
  test::set_vector(outlet, "traction", {0.1, 0.2, -0.3});
  outlet.set("backflow stabilisation", 0.3);
  test::condition(list, "interface", "interface");
  return test::resolved(list, problems::fluid_table());
}

std::vector<Vec3> bulge(const fields::FieldMesh& mesh, double size) {
  std::vector<Vec3> d;
  for (const Vec3& x : mesh.x) {
    const double s = size * x[2] * (3.0 - x[2]);
    d.push_back({s * x[0], s * x[1], 0.1 * s});
  }
  return d;
}

TEUCHOS_UNIT_TEST(fluid_problem, jacobian_is_the_derivative_of_the_residual) {
  const SmallTube tube;
  FluidProblem fluid(open_tube(), tube.fluid);
  fluid.set_initial_velocity([](const Vec3& x) { return Vec3{0.1 * x[1], -0.2, 0.3 + x[0]}; });
  fluid.begin_step(stepping::Clock(0.125, 1));
  TEST_ASSERT(
      fluid.field().set_domain(bulge(tube.fluid, 0.05), bulge(tube.fluid, 0.03)).is_success());
  fluid.prepare();
  const auto x = test::scattered(tube.fluid, 1);  // flow in and out at both ends
  const std::vector<int> interface(1, tube.surface("interface"));
  for (int direction = 2; direction < 5; ++direction) {
    const auto v = test::free_part(tube.fluid, test::scattered(tube.fluid, direction), interface);
    TEST_COMPARE(test::jacobian_error(fluid, x, v, 1e-5), <, 1e-7);
  }
}

/// Prescribed inflow into a windkessel.
Teuchos::ParameterList tube_with_windkessel() {
  auto list = test::fluid_list(1.0, 3.5e-3);
  list.set("time scheme", std::string("implicit euler"));
  test::set_vector(test::condition(list, "inlet", "velocity"), "velocity", {0, 0, 0.2});
  auto& outlet = test::condition(list, "outlet", "windkessel");
  outlet.set("proximal resistance", 2.0);
  outlet.set("capacitance", 0.1);
  outlet.set("distal resistance", 30.0);
  outlet.set("initial pressure", 3.0);
  outlet.set("backflow stabilisation", 0.3);
  test::condition(list, "interface", "no slip");
  return test::resolved(list, problems::fluid_table());
}

TEUCHOS_UNIT_TEST(fluid_problem, jacobian_with_a_windkessel_is_the_derivative_of_the_residual) {
  const SmallTube tube;
  FluidProblem fluid(tube_with_windkessel(), tube.fluid);
  fluid.begin_step(stepping::Clock(0.125, 1));
  TEST_ASSERT(
      fluid.field().set_domain(bulge(tube.fluid, 0.05), bulge(tube.fluid, 0.03)).is_success());
  fluid.prepare();
  const auto x = test::scattered(tube.fluid, 1);
  const std::vector<int> held{tube.surface("interface"), tube.surface("inlet")};
  for (int direction = 2; direction < 5; ++direction) {
    const auto v = test::free_part(tube.fluid, test::scattered(tube.fluid, direction), held);
    TEST_COMPARE(test::jacobian_error(fluid, x, v, 1e-5), <, 1e-7);
  }
}

TEUCHOS_UNIT_TEST(fluid_problem, a_windkessel_lets_out_what_flows_in_against_its_pressure) {
  const SmallTube tube;
  FluidProblem fluid(tube_with_windkessel(), tube.fluid), other(tube_with_windkessel(), tube.fluid);
  double stored = 3.0, rest = 0.0;
  for (stepping::Clock clock(0.5, 4); !clock.is_done(); clock.advance()) {
    fluid.begin_step(clock);
    const auto report = fluid.solve();
    TEST_ASSERT(report.is_converged);
    TEST_COMPARE(report.steps.size(), <=, 5);  // as quickly as without
    fluid.end_step();
    const auto found = fluid.observe();
    const double Q = test::observed(found, "inflow_inlet_mm3_per_ms");
    TEST_FLOATING_EQUALITY(-test::observed(found, "inflow_outlet_mm3_per_ms"), Q, 1e-9);
    stored = (30.0 * Q + 6.0 * stored) / 7.0;  // R_d C/Δt = 6
    TEST_FLOATING_EQUALITY(test::observed(found, "stored_pressure_outlet_kPa"), stored, 1e-9);
    TEST_FLOATING_EQUALITY(test::observed(found, "pressure_outlet_kPa"), stored + 2.0 * Q, 1e-9);
    if (clock.step() == 2) TEST_EQUALITY(test::take_over(fluid, other), "");
    if (clock.step() > 2) {
      other.begin_step(clock);
      TEST_ASSERT(other.solve().is_converged);
      other.end_step();
      rest = std::max(rest, test::relative_difference(other.state(), fluid.state()));
    }
  }
  TEST_EQUALITY(rest, 0.0);  // a restored problem goes on the same
}

TEUCHOS_UNIT_TEST(fluid_problem, rows_of_prescribed_velocities_have_no_residual) {
  const SmallTube tube;
  FluidProblem fluid(open_tube(), tube.fluid);
  fluid.begin_step(stepping::Clock(0.125, 1));
  fluid.prepare();
  algebra::BlockVector F = fields::zero_vector(tube.fluid);
  TEST_ASSERT(fluid.residual(test::scattered(tube.fluid, 1), F).is_success());
  const auto values = F[0].getData();
  for (int a = 0; a < tube.fluid.n_owned; ++a)
    if (tube.fluid.is_on(a, tube.surface("interface")))
      for (int i = 0; i < 3; ++i) TEST_EQUALITY(values[3 * a + i], 0.0);
}

TEUCHOS_UNIT_TEST(fluid_problem, a_parabolic_profile_is_zero_at_the_rim_and_full_in_the_centre) {
  const SmallTube tube;
  auto list = test::fluid_list(1.0, 3.5e-3);
  auto& inlet = test::condition(list, "inlet", "velocity");
  test::set_vector(inlet, "velocity", {0, 0, 2.0});
  inlet.set("profile", std::string("parabolic"));
  auto& amplitude = inlet.sublist("Amplitude").set("kind", std::string("table"));
  const std::vector<double> zero_to_one{0.0, 1.0};
  amplitude.set("times", Teuchos::Array<double>(zero_to_one));
  amplitude.set("values", Teuchos::Array<double>(zero_to_one));
  test::condition(list, "interface", "no slip");
  FluidProblem fluid(test::resolved(list, problems::fluid_table()), tube.fluid);
  fluid.begin_step(stepping::Clock(0.25, 4));  // the amplitude is 0.25
  fluid.prepare();
  const auto u = fields::ghosted_vectors(tube.fluid, fluid.state()[0]);
  double highest = 0.0;
  for (int a = 0; a < tube.fluid.n_owned; ++a) {
    if (!tube.fluid.is_on(a, tube.surface("inlet"))) continue;
    const Vec3& x = tube.fluid.x[a];
    const double expected = 0.5 * (1.0 - (x[0] * x[0] + x[1] * x[1]) / (1.43 * 1.43));
    TEST_COMPARE(std::abs(u[a][2] - expected), <, 1e-12);
    TEST_EQUALITY(u[a][0], 0.0);
    highest = std::max(highest, u[a][2]);
  }
  TEST_FLOATING_EQUALITY(global_max(*test::world(), highest), 0.5, 1e-12);
}

TEUCHOS_UNIT_TEST(fluid_problem, inflow_into_a_closed_fluid_is_refused) {
  const SmallTube tube;
  Teuchos::ParameterList list = test::fluid_list(1.0, 0.1);
  test::set_vector(test::condition(list, "inlet", "velocity"), "velocity", {0, 0, 1});
  test::condition(list, "outlet", "no slip");
  test::condition(list, "interface", "no slip");
  problems::FluidProblem fluid(test::resolved(list, problems::fluid_table()), tube.fluid);
  fluid.begin_step(stepping::Clock(0.1, 1));
  TEST_THROW(fluid.solve(), Error);
}

TEUCHOS_UNIT_TEST(fluid_problem, in_creeping_flow_the_wall_carries_the_load_of_the_inlet) {
  const SmallTube tube;
  auto list = test::fluid_list(1e-12, 1.0);  // next to no inertia
  test::set_vector(test::condition(list, "inlet", "traction"), "traction", {0.5, 0, 1.332});
  test::condition(list, "interface", "no slip");
  FluidProblem fluid(test::resolved(list, problems::fluid_table()), tube.fluid);
  fluid.begin_step(stepping::Clock(1.0, 1));
  TEST_ASSERT(fluid.solve().is_converged);
  const auto force = fluid.reaction();
  Vec3 on_wall{}, elsewhere{};
  for (int a = 0; a < tube.fluid.n_owned; ++a)
    (tube.fluid.is_on(a, tube.surface("interface")) ? on_wall : elsewhere) += force[a];
  const double area = boundary::surface_geometry(tube.fluid, tube.surface("inlet")).area;
  const Vec3 load{0.5 * area, 0.0, 1.332 * area};
  for (int i = 0; i < 3; ++i) {
    TEST_FLOATING_EQUALITY(global_sum(*test::world(), on_wall[i]) + 10.0, load[i] + 10.0, 1e-9);
    TEST_COMPARE(std::abs(global_sum(*test::world(), elsewhere[i])), <, 1e-8);
  }
}

TEUCHOS_UNIT_TEST(fluid_problem, observables_at_rest_are_the_volume_and_zeros) {
  const SmallTube tube;
  const FluidProblem fluid(open_tube(), tube.fluid);
  const auto found = fluid.observe();
  // Regular octagon of radius 1.43 times length 3.
  TEST_FLOATING_EQUALITY(test::observed(found, "fluid_volume_mm3"),
                         3.0 * 4.0 * 1.43 * 1.43 * std::sin(M_PI / 4.0), 1e-12);
  for (const std::string name : {"inflow_inlet_mm3_per_ms", "fluid_pressure_min_kPa",
                                 "fluid_pressure_max_kPa", "max_speed_mm_per_ms"})
    TEST_EQUALITY(test::observed(found, name), 0.0);
}

TEUCHOS_UNIT_TEST(fluid_problem, inflow_of_a_uniform_velocity_is_velocity_times_area) {
  const SmallTube tube;
  FluidProblem fluid(open_tube(), tube.fluid);
  fluid.set_initial_velocity([](const Vec3&) { return Vec3{0, 0, 2}; });
  const double area = 4.0 * 1.43 * 1.43 * std::sin(M_PI / 4.0);
  TEST_FLOATING_EQUALITY(test::observed(fluid.observe(), "inflow_inlet_mm3_per_ms"), 2 * area,
                         1e-12);
  TEST_FLOATING_EQUALITY(test::observed(fluid.observe(), "inflow_outlet_mm3_per_ms"), -2 * area,
                         1e-12);
}

TEUCHOS_UNIT_TEST(fluid_problem, energy_and_powers_of_a_uniform_velocity_are_known) {
  const SmallTube tube;
  auto list = test::fluid_list(1.06, 3.5e-3);
  test::set_vector(test::condition(list, "inlet", "traction"), "traction", {0, 0, 1.332});
  list.sublist("Surfaces").sublist("inlet").set("backflow stabilisation", 0.2);
  test::condition(list, "interface", "interface");
  FluidProblem fluid(test::resolved(list, problems::fluid_table()), tube.fluid);
  fluid.set_initial_velocity([](const Vec3&) { return Vec3{0, 0, 2}; });
  const auto found = fluid.observe();
  const double area = 4.0 * 1.43 * 1.43 * std::sin(M_PI / 4.0);
  const auto expect = [&](const std::string& name, double value) {
    TEST_FLOATING_EQUALITY(test::observed(found, name) + 1.0, value + 1.0, 1e-12);
  };
  expect("fluid_kinetic_energy_kPa_mm3", 0.5 * 1.06 * 4.0 * 3.0 * area);
  expect("viscous_power_kPa_mm3_per_ms", 0.0);
  expect("traction_power_kPa_mm3_per_ms", 1.332 * 2.0 * area);
  expect("kinetic_inflow_kPa_mm3_per_ms", 0.0);  // what enters leaves by the free outlet
  expect("backflow_power_kPa_mm3_per_ms", 0.2 * 1.06 * 8.0 * area);
}

TEUCHOS_UNIT_TEST(fluid_problem, the_interface_has_the_velocity_of_the_mesh) {
  const SmallTube tube;
  FluidProblem fluid(open_tube(), tube.fluid);
  fluid.begin_step(stepping::Clock(0.5, 1));
  const auto d = bulge(tube.fluid, 0.02), d_old = bulge(tube.fluid, 0.01);
  TEST_ASSERT(fluid.field().set_domain(d, d_old).is_success());
  fluid.prepare();
  const auto u = fields::ghosted_vectors(tube.fluid, fluid.state()[0]);
  for (int a = 0; a < tube.fluid.n_owned; ++a)
    if (tube.fluid.is_on(a, tube.surface("interface")))
      TEST_COMPARE(norm(u[a] - 2.0 * (d[a] - d_old[a])), <, 1e-14);
}

TEUCHOS_UNIT_TEST(fluid_problem, an_inverted_element_is_named_on_all_ranks) {
  const SmallTube tube, serial(test::alone());
  FluidProblem fluid(open_tube(), tube.fluid);
  fluid.begin_step(stepping::Clock(0.5, 1));
  const auto push = [](const fields::FieldMesh& mesh) {  // the node on the axis at z = 1
    std::vector<Vec3> d(mesh.n_nodes());
    for (int a = 0; a < mesh.n_nodes(); ++a)
      if (norm(mesh.x[a] - Vec3{0, 0, 1}) < 1e-9) d[a] = {0.3, 0.1, 2.5};
    return d;
  };
  const auto here = fluid.field().set_domain(push(tube.fluid), push(tube.fluid));
  FluidProblem reference(open_tube(), serial.fluid);
  reference.begin_step(stepping::Clock(0.5, 1));
  const auto alone = reference.field().set_domain(push(serial.fluid), push(serial.fluid));
  TEST_ASSERT(here.is_failure() && alone.is_failure());
  TEST_EQUALITY(here.reason(), alone.reason());
  TEST_ASSERT(here.reason().find("element ") == 0);
  TEST_ASSERT(
      fluid.field().set_domain(bulge(tube.fluid, 0.0), bulge(tube.fluid, 0.0)).is_success());
}

TEUCHOS_UNIT_TEST(fluid_problem, a_position_that_is_no_number_is_named) {
  const SmallTube tube;
  FluidProblem fluid(open_tube(), tube.fluid);
  fluid.begin_step(stepping::Clock(0.5, 1));
  std::vector<Vec3> d(tube.fluid.n_nodes());
  d[0][0] = std::nan("");
  TEST_ASSERT(fluid.field().set_domain(d, d).reason().find("nan") != std::string::npos);
}

TEUCHOS_UNIT_TEST(check_inversion, the_most_inverted_element_of_all_ranks_is_chosen) {
  const SmallTube tube;
  const int rank = test::world()->getRank(), last = test::world()->getSize() - 1;
  // The last rank holds the worst element; on rank 0 everything is fine if there are others.
  const double smallest = rank == last ? -5.0 : rank == 0 ? 0.1 : -1.0;
  const auto text = discretisation::check_inversion(tube.fluid, smallest, 0, "det F").reason();
  TEST_ASSERT(text.find("(det F = -5)") != std::string::npos);
  const double mine = rank == last ? tube.fluid.tet_number[0] : 0.0;
  const int number = static_cast<int>(global_sum(*test::world(), mine));
  TEST_ASSERT(text.find("element " + std::to_string(number) + " of \"") == 0);
}

TEUCHOS_UNIT_TEST(check_inversion, what_is_no_number_is_inverted) {
  const SmallTube tube;
  const bool is_first = test::world()->getRank() == 0;
  using discretisation::check_inversion;
  TEST_ASSERT(check_inversion(tube.fluid, is_first ? std::nan("") : 1.0, 0, "det F").is_failure());
  TEST_ASSERT(check_inversion(tube.fluid, 1.0, 0, "det F").is_success());
  TEST_ASSERT(check_inversion(tube.fluid, -1.0, -1, "det F").is_success());  // no element at all
}

TEUCHOS_UNIT_TEST(fluid_problem, an_enclosed_fluid_has_the_same_pressure_on_any_ranks) {
  const SmallTube many, one(test::alone());
  const auto solved = [](const SmallTube& tube) {
    auto list = test::fluid_list(1.0, 3.5e-3);
    for (const char* surface : {"inlet", "outlet"}) {
      auto& velocity = test::condition(list, surface, "velocity");
      test::set_vector(velocity, "velocity", {0, 0, 0.1});
      velocity.set("profile", std::string("parabolic"));
    }
    test::condition(list, "interface", "no slip");
    FluidProblem fluid(test::resolved(list, problems::fluid_table()), tube.fluid);
    fluid.begin_step(stepping::Clock(0.5, 1));
    if (!fluid.solve().is_converged) throw std::runtime_error("not converged");
    return test::by_vertex(tube.fluid, fluid.state(), tube.mesh.vertices.size());
  };
  const auto x = solved(many), reference = solved(one);
  TEST_COMPARE(test::largest_difference(x, reference), <, 1e-9);
  double low = 0.0, high = 0.0;
  for (std::size_t v = 3; v < x.size(); v += 4) {
    low = std::min(low, x[v]);
    high = std::max(high, x[v]);
  }
  TEST_COMPARE(low, <, -1e-3);  // about zero, not above or below a pinned one
  TEST_COMPARE(high, >, 1e-3);
}

TEUCHOS_UNIT_TEST(fluid_problem, an_enclosed_fluid_takes_in_what_it_lets_out) {
  const SmallTube tube;
  const auto solve_with = [&tube](double outlet) {
    auto list = test::fluid_list(1.0, 3.5e-3);
    test::set_vector(test::condition(list, "inlet", "velocity"), "velocity", {0, 0, 0.1});
    test::set_vector(test::condition(list, "outlet", "velocity"), "velocity", {0, 0, outlet});
    test::condition(list, "interface", "no slip");
    FluidProblem fluid(test::resolved(list, problems::fluid_table()), tube.fluid);
    fluid.begin_step(stepping::Clock(0.5, 1));
    return fluid.solve().is_converged;
  };
  TEST_ASSERT(solve_with(0.1));
  TEST_THROW(solve_with(0.102), Error);
}

TEUCHOS_UNIT_TEST(surface_geometry, inlet_is_an_octagon_about_the_axis) {
  const SmallTube tube;
  const auto g = boundary::surface_geometry(tube.fluid, tube.surface("inlet"));
  TEST_FLOATING_EQUALITY(g.area, 4.0 * 1.43 * 1.43 * std::sin(M_PI / 4.0), 1e-12);
  TEST_COMPARE(norm(g.centre), <, 1e-12);
  TEST_FLOATING_EQUALITY(g.radius, 1.43, 1e-12);
}

}  // namespace
