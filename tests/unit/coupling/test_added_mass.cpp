#include <Teuchos_Array.hpp>
#include <Teuchos_UnitTestHarness.hpp>
#include <cmath>
#include <functional>

#include "tunica/boundary/surface_geometry.hpp"
#include "tunica/coupling/added_mass.hpp"
#include "unit/problems/lists.hpp"

namespace {

using namespace tunica;
using coupling::InterfaceVector;
using test::SmallTube;

constexpr double pi = 3.14159265358979323846;

Teuchos::ParameterList wall_solver(const std::string& method) {
  Teuchos::ParameterList list;
  list.set("method", method);
  return test::resolved(list, linear::scalar_solver_table());
}

std::vector<Vec3> areas_of(const SmallTube& tube) {
  return boundary::nodal_areas(tube.fluid, tube.fluid.x, {tube.surface("interface")});
}

constexpr double inertia = 40.0;     // m
constexpr double compliance = 0.05;  // c, where it is the same everywhere

double same_everywhere(const Vec3&) { return compliance; }

/// A tube and its P; c(x) is the compliance at the interface's nodes.
struct Tube {
  explicit Tube(const mesh::Tube& shape = SmallTube::options(), const CommPtr& comm = test::world(),
                const std::vector<std::string>& open = {"inlet", "outlet"},
                const std::function<double(const Vec3&)>& c = same_everywhere,
                const std::string& method = "direct")
      : tube(comm, shape), interface(tube.fluid, tube.wall, {tube.surface("interface")}),
        P(wall_solver(method), tube.fluid, fields::make_node_graph(tube.fluid), interface,
          model(open, c)) {}

  coupling::AddedMassModel model(const std::vector<std::string>& open,
                                 const std::function<double(const Vec3&)>& c) const {
    coupling::AddedMassModel model{tube.fluid.x, areas_of(tube), {}, inertia, {}};
    for (const std::string& name : open) model.open_surfaces.push_back(tube.surface(name));
    for (const int a : interface.fluid_nodes) model.compliance.push_back(c(tube.fluid.x[a]));
    return model;
  }

  /// f(x, outward normal) at the interface's nodes.
  template <class Function>
  InterfaceVector values(Function f) const {
    InterfaceVector r;
    for (const int a : interface.fluid_nodes) {
      const Vec3& x = tube.fluid.x[a];
      const double radius = std::hypot(x[0], x[1]);
      const Vec3 value = f(x, Vec3{x[0] / radius, x[1] / radius, 0.0});
      r.insert(r.end(), value.begin(), value.end());
    }
    return r;
  }
  InterfaceVector scattered(int seed) const {
    InterfaceVector r;
    for (const int a : interface.fluid_nodes)
      for (int i = 0; i < 3; ++i)
        r.push_back(test::scatter(1000.0 * seed + 3.0 * tube.fluid.vertex[a] + i));
    return r;
  }

  SmallTube tube;
  fields::InterfaceTransfer interface;
  coupling::AddedMass P;
};

mesh::Tube shape(int around, int axial) {
  mesh::Tube tube = SmallTube::options();
  tube.around = around;
  tube.axial = axial;
  return tube;
}

/// Largest error of P for r = sin(kz) n, against the exact flow in a round tube of radius R:
/// c p = I0(kr)/(I0(kR) + k/(c m) I1(kR)) sin(kz), k = π/length.
double error_of_a_sine(int around, int axial, const std::string& method) {
  const mesh::Tube options = shape(around, axial);
  Tube tube(options, test::world(), {"inlet", "outlet"}, same_everywhere, method);
  const double k = pi / options.length, R = options.radius;
  const double I0 = std::cyl_bessel_i(0, k * R), I1 = std::cyl_bessel_i(1, k * R);
  const double flux = k / (compliance * inertia) * I1;
  const double kept = flux / (I0 + flux);
  const auto sine = [&](double size) {
    return tube.values([&](const Vec3& x, const Vec3& n) { return size * std::sin(k * x[2]) * n; });
  };
  const InterfaceVector z = tube.P.apply(sine(1.0)), exact = sine(kept);
  double error = 0.0;
  for (std::size_t i = 0; i < z.size(); ++i) error = std::max(error, std::abs(z[i] - exact[i]));
  return global_max(*test::world(), error) / kept;
}

TEUCHOS_UNIT_TEST(added_mass, leaves_of_a_sine_what_the_flow_in_a_round_tube_does_not_take_back) {
  for (const std::string method : {"direct", "cg"}) {
    const double coarse = error_of_a_sine(12, 6, method), fine = error_of_a_sine(24, 12, method);
    TEST_COMPARE(coarse, <, 0.2);
    TEST_COMPARE(fine, <, 0.3 * coarse);  // second order
  }
}

TEUCHOS_UNIT_TEST(added_mass, a_closed_fluid_takes_back_what_would_change_its_volume) {
  const mesh::Tube options = SmallTube::options();
  // The pressure is constant; the wall yields to it where it can, and keeps the volume.
  const auto c = [&](const Vec3& x) { return x[2] > 0.5 * options.length ? compliance : 0.0; };
  Tube tube(options, test::world(), {}, c);
  const InterfaceVector r =
      tube.values([&](const Vec3& x, const Vec3& n) { return 3.0 * c(x) * n; });
  for (const double z : tube.P.apply(r)) TEST_COMPARE(std::abs(z), <, 1e-10);
}

TEUCHOS_UNIT_TEST(added_mass, what_a_stiff_wall_does_not_yield_is_not_taken_back) {
  const mesh::Tube options = SmallTube::options();
  Tube tube(options, test::world(), {"inlet", "outlet"},
            [&](const Vec3& x) { return x[2] < 0.6 * options.length ? 0.0 : compliance; });
  const InterfaceVector r = tube.scattered(7), z = tube.P.apply(r);
  double rigid = 0.0, soft = 0.0;
  for (int k = 0; k < tube.interface.n_owned(); ++k) {
    const bool is_rigid =
        tube.tube.fluid.x[tube.interface.fluid_nodes[k]][2] < 0.6 * options.length;
    for (int i = 3 * k; i < 3 * k + 3; ++i)
      (is_rigid ? rigid : soft) = std::max(is_rigid ? rigid : soft, std::abs(z[i] - r[i]));
  }
  TEST_EQUALITY(global_max(*test::world(), rigid), 0.0);
  TEST_COMPARE(global_max(*test::world(), soft), >, 0.1);
}

TEUCHOS_UNIT_TEST(added_mass, a_residual_that_is_no_number_comes_back_as_it_is) {
  Tube tube(SmallTube::options(), test::world(), {"inlet", "outlet"}, same_everywhere, "cg");
  InterfaceVector r = tube.scattered(1);
  if (!r.empty()) r[0] = std::nan("");
  const InterfaceVector z = tube.P.apply(r);
  for (std::size_t i = 1; i < r.size(); ++i) TEST_EQUALITY(z[i], r[i]);
}

TEUCHOS_UNIT_TEST(added_mass, leaves_tangential_residuals_alone) {
  Tube tube;
  const auto swirl = [](const Vec3& x, const Vec3& n) {
    return Vec3{-0.3 * n[1], 0.3 * n[0], 1.0 + x[2]};
  };
  const InterfaceVector r = tube.values(swirl);
  const InterfaceVector z = tube.P.apply(r);
  TEST_COMPARE(test::largest_difference(z, r), <, 1e-12);
}

TEUCHOS_UNIT_TEST(added_mass, is_self_adjoint_and_takes_between_nothing_and_all) {
  Tube tube;
  const Comm& comm = *test::world();
  const std::vector<Vec3> area = areas_of(tube.tube);
  // One compliance everywhere: the weight of the scalar product is the area. Only normal parts.
  const auto product = [&](const InterfaceVector& a, const InterfaceVector& b) {
    double sum = 0.0;
    for (int k = 0; k < tube.interface.n_owned(); ++k) {
      const Vec3& A = area[tube.interface.fluid_nodes[k]];
      const auto normal = [&](const InterfaceVector& r) {
        return dot(A, {r[3 * k], r[3 * k + 1], r[3 * k + 2]}) / norm(A);
      };
      const double z = tube.tube.fluid.x[tube.interface.fluid_nodes[k]][2];
      const bool is_open = z < 1e-9 || z > SmallTube::options().length - 1e-9;
      if (!is_open) sum += norm(A) * normal(a) * normal(b);
    }
    return global_sum(comm, sum);
  };
  for (int seed = 1; seed < 4; ++seed) {
    const InterfaceVector a = tube.scattered(seed), b = tube.scattered(seed + 10);
    const InterfaceVector Pa = tube.P.apply(a), Pb = tube.P.apply(b);
    TEST_FLOATING_EQUALITY(product(Pa, b), product(a, Pb), 1e-9);
    TEST_COMPARE(product(Pa, a), >, 0.0);
    TEST_COMPARE(product(Pa, a), <, product(a, a));
  }
}

TEUCHOS_UNIT_TEST(added_mass, does_not_depend_on_the_ranks) {
  Tube many, one(SmallTube::options(), test::alone());
  const InterfaceVector found = many.P.apply(many.scattered(1)),
                        expected = one.P.apply(one.scattered(1));
  for (int k = 0; k < many.interface.n_owned(); ++k) {
    const int vertex = many.tube.fluid.vertex[many.interface.fluid_nodes[k]];
    for (int j = 0; j < one.interface.n_owned(); ++j)
      if (one.tube.fluid.vertex[one.interface.fluid_nodes[j]] == vertex)
        for (int i = 0; i < 3; ++i)
          TEST_COMPARE(std::abs(found[3 * k + i] - expected[3 * j + i]), <, 1e-12);
  }
}

Teuchos::ParameterList clamped_wall(const std::string& inside) {
  auto list = test::wall_list();
  test::condition(list, "struct_in", "clamped");
  test::condition(list, "struct_out", "clamped");
  test::condition(list, "interface", inside);
  return list;
}

TEUCHOS_UNIT_TEST(wall_compliance, is_what_a_small_pressure_moves_the_wall_by) {
  const SmallTube tube;
  const fields::InterfaceTransfer interface(tube.fluid, tube.wall, {tube.surface("interface")});
  const double pressure = 1e-4;
  for (const std::string method : {"direct", "gcr"})
    for (const double dt : {0.125, 2.0}) {
      const stepping::Clock clock(dt, 1);
      auto list = clamped_wall("interface");
      list.sublist("Linear Solver").set("method", method);
      problems::SolidProblem wall(test::resolved(list, problems::solid_table()), tube.wall);
      wall.begin_step(clock);
      const auto c = coupling::wall_compliance(interface, areas_of(tube), wall);
      list = clamped_wall("pressure");
      list.sublist("Surfaces").sublist("interface").set("pressure", pressure);
      problems::SolidProblem pressed(test::resolved(list, problems::solid_table()), tube.wall);
      pressed.begin_step(clock);
      TEST_ASSERT(pressed.solve().is_converged);
      const std::vector<Vec3> d = pressed.displacement();
      TEST_ASSERT(c.is_success());
      for (int k = 0; k < interface.n_owned(); ++k) {
        const Vec3& x = tube.wall.x[interface.wall_nodes[k]];
        const Vec3& moved = d[interface.wall_nodes[k]];
        const double outward = (x[0] * moved[0] + x[1] * moved[1]) / std::hypot(x[0], x[1]);
        TEST_COMPARE(std::abs(c.value()[k] - outward / pressure), <=, 2e-3 * c.value()[k] + 1e-12);
      }
    }
}

TEUCHOS_UNIT_TEST(wall_compliance, says_why_the_wall_cannot_be_solved) {
  const SmallTube tube;
  const fields::InterfaceTransfer interface(tube.fluid, tube.wall, {tube.surface("interface")});
  auto list = clamped_wall("interface");
  list.remove("Linear Solver");
  list.sublist("Linear Solver")
      .set("preconditioner", std::string("ilu"))
      .set("max iterations", 1)
      .set("fallbacks", Teuchos::Array<std::string>());
  problems::SolidProblem wall(test::resolved(list, problems::solid_table()), tube.wall);
  wall.begin_step(stepping::Clock(0.125, 1));
  const auto c = coupling::wall_compliance(interface, areas_of(tube), wall);
  TEST_ASSERT(c.reason().find("relative residual") != std::string::npos);
}

}  // namespace
