#include <Teuchos_UnitTestHarness.hpp>

#include "tunica/base/error.hpp"
#include "tunica/boundary/cap.hpp"
#include "tunica/boundary/surface_geometry.hpp"
#include "tunica/boundary/surface_terms.hpp"
#include "tunica/mesh/block.hpp"
#include "unit/fields/small_tube.hpp"
#include "verify/womersley.hpp"

namespace {

using namespace tunica;
using boundary::Cap;
using test::SmallTube;

mesh::Tube fine_tube() {
  mesh::Tube tube;
  tube.radius = 2.0;
  tube.around = 64;
  tube.rings = 24;
  tube.axial = 2;
  tube.length = 0.2;
  tube.with_wall = false;
  return tube;
}

Cap inlet_of(const mesh::Mesh& mesh, const std::string& name) {
  const auto field = fields::make_field_mesh(test::share_of(mesh, {true}), {0});
  return boundary::gather_cap(field, mesh::surface_index(mesh, name));
}

TEUCHOS_UNIT_TEST(cap, every_rank_has_all_of_it) {
  const SmallTube tube, alone(test::alone());
  const Cap cap = boundary::gather_cap(tube.fluid, tube.surface("inlet"));
  const Cap whole = boundary::gather_cap(alone.fluid, tube.surface("inlet"));
  TEST_COMPARE_ARRAYS(cap.vertex, whole.vertex);
  TEST_ASSERT(cap.x == whole.x && cap.is_rim == whole.is_rim && cap.triangles == whole.triangles);
  const auto on_rim = std::count(cap.is_rim.begin(), cap.is_rim.end(), 1);
  TEST_EQUALITY(on_rim, 8);
  TEST_EQUALITY(cap.find(-3), -1);
  TEST_EQUALITY(cap.find(cap.vertex[2]), 2);
}

TEUCHOS_UNIT_TEST(cap, a_steady_flow_has_a_parabola_in_a_pipe) {
  const Cap cap = inlet_of(mesh::make_tube(fine_tube()), "inlet");
  const auto phi = boundary::harmonic_profile(cap);
  TEST_FLOATING_EQUALITY(boundary::integral(cap, phi), 1.0, 1e-13);
  for (int a = 0; a < cap.n_nodes(); ++a) {
    const double r = std::hypot(cap.x[a][0], cap.x[a][1]) / 2.0, peak = 2.0 / (M_PI * 4.0);
    TEST_COMPARE(std::abs(phi[a] - peak * (1.0 - r * r)), <, 0.005 * peak);
  }
}

TEUCHOS_UNIT_TEST(cap, a_steady_flow_has_the_peak_of_a_square_duct) {
  mesh::Block block;
  block.size = {1.0, 1.0, 0.5};
  block.cells = {32, 32, 1};
  const mesh::Mesh mesh = mesh::make_block(block);
  const Cap cap = inlet_of(mesh, "z_low");
  const auto phi = boundary::harmonic_profile(cap);
  // series of the square duct: the velocity on the axis is 2.0963 of the mean
  TEST_FLOATING_EQUALITY(*std::max_element(phi.begin(), phi.end()), 2.0963, 0.005);
  for (int a = 0; a < cap.n_nodes(); ++a) TEST_ASSERT(!cap.is_rim[a] || phi[a] == 0.0);
}

TEUCHOS_UNIT_TEST(cap, a_swinging_flow_has_womersleys_profile_in_a_pipe) {
  const Cap cap = inlet_of(mesh::make_tube(fine_tube()), "inlet");
  for (const double alpha : {0.5, 3.0, 8.0}) {
    const double nu = 3.3e-3, omega = alpha * alpha * nu / 4.0;  // α = R √(ω/ν)
    const verify::Womersley exact{1.0, nu, 2.0, {0.0, omega}};
    const auto phi = boundary::womersley_profile(cap, omega, nu);
    double largest = 0.0, worst = 0.0;
    for (int a = 0; a < cap.n_nodes(); ++a) {
      const double r = std::min(2.0, std::hypot(cap.x[a][0], cap.x[a][1]));
      const auto expected = exact.velocity(1.0, r) / exact.flow_rate(1.0);
      largest = std::max(largest, std::abs(expected));
      worst = std::max(worst, std::abs(phi[a] - expected));
    }
    TEST_COMPARE(worst, <, 0.01 * largest);
  }
}

boundary::Condition flow_rate(const std::string& profile) {
  Teuchos::ParameterList list;
  list.set("condition", "flow rate").set("flow rate", 3.0).set("profile", profile);
  auto& amplitude = list.sublist("Amplitude");
  amplitude.set("kind", "table").set("period", 800.0);
  amplitude.set("times", Teuchos::Array<double>(Teuchos::tuple(0.0, 100.0, 300.0)));
  amplitude.set("values", Teuchos::Array<double>(Teuchos::tuple(0.2, 1.0, 0.1)));
  boundary::condition_table("", boundary::fluid_conditions()).resolve(list, "inlet", "");
  return {"inlet", list};
}

TEUCHOS_UNIT_TEST(flow_rate, is_met_at_all_times_whatever_the_profile_and_the_size) {
  const SmallTube tube;
  const fields::FieldMesh& mesh = tube.fluid;
  const int inlet = tube.surface("inlet");
  const std::vector<Vec3> zero(mesh.n_nodes());
  std::vector<Vec3> grown(mesh.x), bent(mesh.x);
  for (Vec3& x : grown) x = {1.3 * x[0], 1.3 * x[1], x[2]};
  for (Vec3& x : bent) x = {x[0] + 0.2 * x[0] * x[0], x[1] - 0.1 * x[0] * x[1], x[2]};
  const std::map<double, double> flow{{0.0, 0.2}, {50.0, 0.6}, {350.0, 0.11}, {1700.0, 1.0}};
  for (const char* profile : {"flat", "parabolic", "womersley"}) {
    boundary::SurfaceTerms terms({flow_rate(profile)}, boundary::fluid_conditions(), mesh);
    for (const std::vector<Vec3>* position : {&mesh.x, &std::as_const(grown), &std::as_const(bent)})
      for (const auto& [time, expected] : flow) {
        boundary::Surroundings s{&mesh, &mesh.x, position, &zero, &zero, 1.06, time};
        s.viscosity = 3.5e-3;
        Vector u(mesh.vector_map);
        terms.impose(s, u);
        const auto values = fields::owned_vectors(mesh, u);
        const auto area = boundary::nodal_areas(mesh, *position, {inlet});
        double mine = 0.0;
        for (int a = 0; a < mesh.n_owned; ++a) {
          mine -= dot(area[a], values[a]);
          if (mesh.is_on(a, inlet) && mesh.is_on(a, tube.surface("interface")))
            TEST_EQUALITY(norm(values[a]), 0.0);
        }
        TEST_FLOATING_EQUALITY(global_sum(*mesh.comm, mine), 3.0 * expected, 1e-12);
      }
  }
}

TEUCHOS_UNIT_TEST(flow_rate, womersleys_profile_wants_a_period) {
  Teuchos::ParameterList list;
  list.set("condition", "flow rate").set("flow rate", 3.0).set("profile", "womersley");
  TEST_THROW(boundary::condition_table("", boundary::fluid_conditions()).resolve(list, "inlet", ""),
             Error);
}

boundary::Condition sliding(const std::string& surface,
                            const std::vector<std::string>& components) {
  Teuchos::ParameterList list;
  list.set("condition", "held");
  list.set("components", Teuchos::Array<std::string>(components));
  boundary::condition_table("", boundary::fluid_conditions()).resolve(list, surface, "");
  return {surface, list};
}

TEUCHOS_UNIT_TEST(velocity, a_round_profile_is_refused_where_a_plane_of_symmetry_cuts_the_section) {
  const SmallTube tube;
  Teuchos::ParameterList list;
  list.set("condition", "velocity").set("profile", "parabolic");
  list.set("velocity", Teuchos::Array<double>(Teuchos::tuple(0.0, 0.0, 1.0)));
  boundary::condition_table("", boundary::fluid_conditions()).resolve(list, "inlet", "");
  const auto registry = boundary::fluid_conditions();
  const auto make = [&](const std::string& plane) {
    boundary::SurfaceTerms({{"inlet", list}, sliding(plane, {"x"})}, registry, tube.fluid);
  };
  TEST_THROW(make("interface"), Error);  // touches the inlet
  TEST_NOTHROW(make("outlet"));
}

// u = 6 Q y (H − y)/(W H³) between walls H apart, which planes of symmetry cut W wide: a parabola
// of y that does not depend on x.
TEUCHOS_UNIT_TEST(flow_rate, has_a_parabola_in_a_slot_between_planes_of_symmetry) {
  constexpr double H = 0.8, W = 0.1, Q = 3.0;
  mesh::Block shape;
  shape.size = {W, H, 1.0};
  shape.cells = {1, 8, 2};
  const mesh::Mesh block = mesh::make_block(shape);
  const auto mesh = fields::make_field_mesh(test::share_of(block, {true}), {0});
  const std::vector<Vec3> zero(mesh.n_nodes());
  const auto at_inlet = [&](const std::string& profile, const std::vector<std::string>& held_x,
                            const std::function<double(double)>& expected) {
    boundary::Condition inlet = flow_rate(profile);
    inlet.surface = "z_low";
    boundary::SurfaceTerms terms({inlet, sliding("x_low", held_x), sliding("x_high", {"normal"})},
                                 boundary::fluid_conditions(), mesh);
    boundary::Surroundings s{&mesh, &mesh.x, &mesh.x, &zero, &zero, 1.06, 100.0};
    s.viscosity = 3.5e-3;
    Vector u(mesh.vector_map);
    terms.impose(s, u);
    const auto values = fields::owned_vectors(mesh, u);
    double worst = 0.0;
    for (int a = 0; a < mesh.n_owned; ++a)
      if (mesh.is_on(a, mesh::surface_index(block, "z_low")))
        worst = std::max(worst, std::abs(values[a][2] - expected(mesh.x[a][1])));
    return global_max(*mesh.comm, worst);
  };
  const auto parabola = [&](double y) { return 6.0 * Q * y * (H - y) / (W * H * H * H); };
  // The interpolant of the parabola has (1 − 1/n²) of its flow, n = 8 cells.
  const auto discrete = [&](double y) { return parabola(y) / (1.0 - 1.0 / 64.0); };
  TEST_COMPARE(at_inlet("parabolic", {"x"}, discrete), <, 1e-10 * parabola(0.5 * H));
  const auto flat = [&](double y) { return y > 0.0 && y < H ? Q / (W * H * 7.0 / 8.0) : 0.0; };
  TEST_COMPARE(at_inlet("flat", {"x"}, flat), <, 1e-10 * parabola(0.5 * H));
  // A surface that does not let the flow pass is a wall.
  TEST_COMPARE(at_inlet("parabolic", {"x", "y"}, discrete), <, 1e-10 * parabola(0.5 * H));
  TEST_ASSERT(at_inlet("parabolic", {"x", "z"}, discrete) > 0.1 * parabola(0.5 * H));
}

}  // namespace
