#include <Teuchos_UnitTestHarness.hpp>
#include <cmath>

#include "base/error.hpp"
#include "coupling/added_mass.hpp"
#include "unit/problems/lists.hpp"

namespace {

using namespace tunica;
using coupling::InterfaceVector;
using test::SmallTube;

constexpr double pi = 3.14159265358979323846;

Teuchos::ParameterList solver() {
  Teuchos::ParameterList list;
  list.set("method", std::string("direct"));
  return test::resolved(list, linear::scalar_solver_table());
}

/// A tube whose ends are open, with P for one c m everywhere.
struct Tube {
  Tube(double c_m, const mesh::Tube& shape, const CommPtr& comm = test::world())
      : tube(comm, shape), interface(tube.fluid, tube.wall, {tube.surface("interface")}),
        P(solver(), tube.fluid, interface, {tube.surface("inlet"), tube.surface("outlet")},
          std::vector<double>(interface.n_owned(), 0.5 * c_m), 2.0) {}

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
  fields::Interface interface;
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
double error_of_a_sine(int around, int axial) {
  const double c_m = 2.0;
  Tube tube(c_m, shape(around, axial));
  const mesh::Tube options = shape(around, axial);
  const double k = pi / options.length, R = options.radius;
  const double I0 = std::cyl_bessel_i(0, k * R), I1 = std::cyl_bessel_i(1, k * R);
  const double kept = k / c_m * I1 / (I0 + k / c_m * I1);
  const auto sine = [&](double size) {
    return tube.values([&](const Vec3& x, const Vec3& n) { return size * std::sin(k * x[2]) * n; });
  };
  const InterfaceVector z = tube.P.apply(sine(1.0)), exact = sine(kept);
  double error = 0.0;
  for (std::size_t i = 0; i < z.size(); ++i) error = std::max(error, std::abs(z[i] - exact[i]));
  return fields::global_max(*test::world(), error) / kept;
}

TEUCHOS_UNIT_TEST(added_mass, leaves_of_a_sine_what_the_flow_in_a_round_tube_does_not_take_back) {
  const double coarse = error_of_a_sine(12, 6), fine = error_of_a_sine(24, 12);
  TEST_COMPARE(coarse, <, 0.2);
  TEST_COMPARE(fine, <, 0.3 * coarse);  // second order
}

TEUCHOS_UNIT_TEST(added_mass, leaves_tangential_residuals_alone) {
  Tube tube(2.0, SmallTube::options());
  const InterfaceVector r = tube.values([](const Vec3& x, const Vec3& n) {
    return Vec3{-0.3 * n[1], 0.3 * n[0], 1.0 + x[2]};
  });
  const InterfaceVector z = tube.P.apply(r);
  TEST_COMPARE(test::largest_difference(z, r), <, 1e-12);
}

TEUCHOS_UNIT_TEST(added_mass, is_self_adjoint_and_takes_between_nothing_and_all) {
  Tube tube(2.0, SmallTube::options());
  const Comm& comm = *test::world();
  const std::vector<Vec3> area =
      problems::nodal_areas(tube.tube.fluid, {tube.tube.surface("interface")});
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
    return fields::global_sum(comm, sum);
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
  Tube many(2.0, SmallTube::options()), one(2.0, SmallTube::options(), test::alone());
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
  const fields::Interface interface(tube.fluid, tube.wall, {tube.surface("interface")});
  const double pressure = 1e-4;
  for (const double dt : {0.125, 2.0}) {
    const stepping::Clock clock(dt, 1);
    problems::SolidProblem wall(test::resolved(clamped_wall("interface"), problems::solid_table()),
                                tube.wall);
    const std::vector<double> c = coupling::wall_compliance(clock, tube.fluid, interface, wall);
    auto list = clamped_wall("pressure");
    list.sublist("Surfaces").sublist("interface").set("pressure", pressure);
    problems::SolidProblem pressed(test::resolved(list, problems::solid_table()), tube.wall);
    pressed.begin_step(clock);
    TEST_ASSERT(pressed.solve().is_converged);
    const std::vector<Vec3> d = pressed.displacement();
    for (int k = 0; k < interface.n_owned(); ++k) {
      const Vec3& x = tube.wall.x[interface.wall_nodes[k]];
      const Vec3& moved = d[interface.wall_nodes[k]];
      const double outward = (x[0] * moved[0] + x[1] * moved[1]) / std::hypot(x[0], x[1]);
      TEST_COMPARE(std::abs(c[k] - outward / pressure), <=, 2e-3 * c[k] + 1e-12);
    }
  }
}

TEUCHOS_UNIT_TEST(wall_compliance, names_the_way_out_where_the_wall_cannot_be_solved) {
  const SmallTube tube;
  const fields::Interface interface(tube.fluid, tube.wall, {tube.surface("interface")});
  auto list = clamped_wall("interface");
  list.remove("Linear Solver");
  list.sublist("Linear Solver").set("preconditioner", std::string("ilu")).set("max iterations", 1);
  problems::SolidProblem wall(test::resolved(list, problems::solid_table()), tube.wall);
  try {
    coupling::wall_compliance(stepping::Clock(0.125, 1), tube.fluid, interface, wall);
    TEST_ASSERT(false);
  } catch (const Error& error) {
    TEST_ASSERT(std::string(error.what()).find("\"none\" does without") != std::string::npos);
  }
}

}  // namespace
