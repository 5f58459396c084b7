#include <Teuchos_UnitTestHarness.hpp>

#include "tunica/problems/solid_problem.hpp"
#include "unit/problems/lists.hpp"

namespace {

using namespace tunica;
using discretisation::Observables;
using problems::FluidProblem;
using problems::SolidProblem;
using test::SmallTube;

const double octagon = 4.0 * 1.43 * 1.43 * std::sin(M_PI / 4.0);

Vec3 vector(const Observables& found, const std::string& name) {
  return {test::observed(found, name + "_x_mN"), test::observed(found, name + "_y_mN"),
          test::observed(found, name + "_z_mN")};
}

/// Pressure and viscous part.
Vec3 force(const Observables& found, const std::string& surface) {
  return vector(found, "pressure_force_" + surface) + vector(found, "viscous_force_" + surface);
}

std::vector<int> surfaces_of(const SmallTube& tube) {
  return fields::bounding_surfaces(tube.fluid);
}

FluidProblem fluid_of(const SmallTube& tube, const Teuchos::ParameterList& list) {
  return FluidProblem(test::resolved(list, problems::fluid_table()), tube.fluid);
}

TEUCHOS_UNIT_TEST(surface_report, a_fluid_at_rest_weighs_upon_its_box) {
  const SmallTube tube;
  auto list = test::fluid_list(1.06, 3.5e-3);
  for (const char* surface : {"inlet", "outlet", "interface"})
    test::condition(list, surface, "no slip");
  FluidProblem fluid = fluid_of(tube, list);
  const Vec3 g{0.02, 0.0, -0.01};
  fluid.field().set_body_force([g](const Vec3&, double) { return g; });
  fluid.begin_step(stepping::Clock(0.5, 1));
  TEST_ASSERT(fluid.solve().is_converged);
  const auto found = fluid.observe_surfaces(surfaces_of(tube));
  // p = ρ g·(x − c) about the centre c, half of the length 3 above the inlet.
  const double end = 1.06 * 0.01 * 1.5;
  const auto expect = [&](const std::string& surface, const Vec3& load) {
    TEST_COMPARE(norm(vector(found, "pressure_force_" + surface) - load), <, 1e-11);
    TEST_COMPARE(norm(vector(found, "viscous_force_" + surface)), <, 1e-11);
  };
  expect("inlet", {0, 0, -end * octagon});
  expect("outlet", {0, 0, -end * octagon});
  expect("interface", {1.06 * 0.02 * 3.0 * octagon, 0, 0});
  TEST_COMPARE(std::abs(test::observed(found, "mean_pressure_inlet_kPa") - end), <, 1e-12);
  TEST_COMPARE(std::abs(test::observed(found, "mean_pressure_outlet_kPa") + end), <, 1e-12);
}

TEUCHOS_UNIT_TEST(surface_report, in_creeping_flow_the_drag_is_the_pressure_drop_times_the_area) {
  const SmallTube tube;
  auto list = test::fluid_list(1e-12, 0.1);  // next to no inertia
  test::condition(list, "inlet", "pressure").set("pressure", 0.04);
  test::condition(list, "interface", "no slip");
  FluidProblem fluid = fluid_of(tube, list);
  fluid.begin_step(stepping::Clock(1.0, 1));
  TEST_ASSERT(fluid.solve().is_converged);
  const auto found = fluid.observe_surfaces(surfaces_of(tube));
  TEST_COMPARE(norm(force(found, "inlet") - Vec3{0, 0, -0.04 * octagon}), <, 1e-13);
  TEST_COMPARE(norm(force(found, "outlet")), <, 1e-13);  // not listed: free
  TEST_COMPARE(std::abs(force(found, "interface")[2] - 0.04 * octagon), <, 1e-10);
  // The pressure acts on it radially, so that all of the drag is friction.
  TEST_COMPARE(std::abs(vector(found, "pressure_force_interface")[2]), <, 1e-13);
}

TEUCHOS_UNIT_TEST(surface_report, walls_are_what_the_fluid_sticks_to_by_any_condition) {
  const SmallTube tube;
  const auto shear_with = [&tube](const std::string& kind) {
    auto list = test::fluid_list(1e-12, 0.1);
    test::condition(list, "inlet", "pressure").set("pressure", 0.04);
    auto& wall = test::condition(list, "interface", kind);
    if (kind == "velocity") test::set_vector(wall, "velocity", {0, 0, 0});
    FluidProblem fluid = fluid_of(tube, list);
    fluid.begin_step(stepping::Clock(1.0, 1));
    if (!fluid.solve().is_converged) throw std::runtime_error("not converged");
    double sum = 0.0;
    for (const Vec3& shear : fluid.wall_shear_stress()) sum += norm(shear);
    return global_sum(*test::world(), sum);
  };
  const double expected = shear_with("no slip");
  TEST_COMPARE(expected, >, 1e-3);
  TEST_FLOATING_EQUALITY(shear_with("velocity"), expected, 1e-12);
}

TEUCHOS_UNIT_TEST(surface_report, area_and_inflow_are_those_of_the_deformed_surface) {
  const SmallTube tube;
  auto list = test::fluid_list(1.0, 3.5e-3);
  test::condition(list, "inlet", "pressure").set("pressure", 0.0);
  test::condition(list, "interface", "interface");
  FluidProblem fluid = fluid_of(tube, list);
  fluid.set_initial_velocity([](const Vec3&) { return Vec3{0, 0, 2}; });
  fluid.begin_step(stepping::Clock(0.5, 1));
  std::vector<Vec3> d;
  for (const Vec3& x : tube.fluid.x) d.push_back(0.1 * x);
  TEST_ASSERT(fluid.field().set_domain(d, d).is_success());
  const auto found = fluid.observe_surfaces(surfaces_of(tube));
  const auto expect = [&](const std::string& name, double value) {
    TEST_FLOATING_EQUALITY(test::observed(found, name), value, 1e-12);
  };
  expect("area_inlet_mm2", 1.21 * octagon);
  expect("area_outlet_mm2", 1.21 * octagon);
  expect("area_interface_mm2", 1.21 * 3.0 * 16.0 * 1.43 * std::sin(M_PI / 8.0));
  expect("inflow_outlet_mm3_per_ms", -2.0 * 1.21 * octagon);
  // That of a listed surface is among the observables of the fluid as a whole, and a wall has none.
  for (const char* name : {"inflow_inlet_mm3_per_ms", "inflow_interface_mm3_per_ms"})
    TEST_ASSERT(std::isnan(test::observed(found, name)));
}

TEUCHOS_UNIT_TEST(surface_report, observing_leaves_the_run_as_it_was) {
  const SmallTube tube;
  auto list = test::fluid_list(1.0, 3.5e-3);
  auto& inlet = test::condition(list, "inlet", "pressure").set("pressure", 0.04);
  inlet.set("backflow stabilisation", 0.2);
  test::condition(list, "interface", "no slip");
  FluidProblem observed = fluid_of(tube, list), alone = fluid_of(tube, list);
  for (stepping::Clock clock(0.5, 2); !clock.is_done(); clock.advance())
    for (FluidProblem* fluid : {&observed, &alone}) {
      fluid->begin_step(clock);
      TEST_ASSERT(fluid->solve().is_converged);
      if (fluid == &observed) TEST_ASSERT(!fluid->observe_surfaces(surfaces_of(tube)).empty());
    }
  TEST_EQUALITY(test::relative_difference(observed.state(), alone.state()), 0.0);
}

TEUCHOS_UNIT_TEST(surface_report, forces_before_the_first_solve_are_no_numbers) {
  const SmallTube tube;
  auto list = test::fluid_list(1.0, 3.5e-3);
  test::condition(list, "interface", "no slip");
  FluidProblem fluid = fluid_of(tube, list);
  const auto found = fluid.observe_surfaces(surfaces_of(tube));
  TEST_ASSERT(std::isnan(test::observed(found, "viscous_force_interface_z_mN")));
  TEST_EQUALITY(test::observed(found, "viscous_force_inlet_z_mN"), 0.0);
  TEST_ASSERT(fluid.observe_surfaces({}).empty());
}

TEUCHOS_UNIT_TEST(surface_report, a_clamped_end_carries_the_load_of_the_wall) {
  const SmallTube tube;
  auto list = test::wall_list();
  list.set("analysis", std::string("static"));
  test::condition(list, "struct_in", "clamped");
  const Vec3 t{0.01, 0.0, 0.2};
  test::set_vector(test::condition(list, "struct_out", "traction"), "traction", t);
  SolidProblem wall(test::resolved(list, problems::solid_table()), tube.wall);
  wall.begin_step(stepping::Clock(1.0, 1));
  TEST_ASSERT(wall.solve().is_converged);
  const auto found = wall.observe_surfaces(fields::bounding_surfaces(tube.wall));
  const double ring = octagon * (1.82 * 1.82 / (1.43 * 1.43) - 1.0);
  TEST_COMPARE(norm(vector(found, "wall_force_struct_in") - ring * t), <, 1e-9);
  TEST_FLOATING_EQUALITY(test::observed(found, "wall_area_struct_in_mm2"), ring, 1e-12);
  TEST_ASSERT(std::isnan(test::observed(found, "mean_displacement_struct_in_z_mm")));  // it is 0
  TEST_COMPARE(test::observed(found, "mean_displacement_struct_out_z_mm"), >, 1e-3);
  TEST_ASSERT(std::isnan(test::observed(found, "wall_force_struct_out_z_mN")));
  TEST_ASSERT(std::isnan(test::observed(found, "wall_area_inlet_mm2")));  // of the fluid
}

TEUCHOS_UNIT_TEST(surface_report, surfaces_that_hold_the_wall_share_its_load) {
  const SmallTube tube;
  auto list = test::wall_list();
  list.set("analysis", std::string("static"));
  test::condition(list, "struct_in", "clamped");
  test::condition(list, "outer", "held").set("components", Teuchos::Array<std::string>(1, "z"));
  const Vec3 t{0.01, 0.0, 0.2};
  test::set_vector(test::condition(list, "struct_out", "traction"), "traction", t);
  SolidProblem wall(test::resolved(list, problems::solid_table()), tube.wall);
  wall.begin_step(stepping::Clock(1.0, 1));
  TEST_ASSERT(wall.solve().is_converged);
  const auto found = wall.observe_surfaces(fields::bounding_surfaces(tube.wall));
  const double ring = octagon * (1.82 * 1.82 / (1.43 * 1.43) - 1.0);
  const Vec3 end = vector(found, "wall_force_struct_in"), side = vector(found, "wall_force_outer");
  TEST_COMPARE(norm(end + side - ring * t), <, 1e-9);
  TEST_EQUALITY(side[0], 0.0);  // it is held in z only
  TEST_COMPARE(side[2], >, 0.1 * ring * t[2]);
}

}  // namespace
