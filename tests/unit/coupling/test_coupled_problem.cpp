#include <Teuchos_UnitTestHarness.hpp>
#include <map>

#include "tunica/base/error.hpp"
#include "unit/coupling/coupled_tube.hpp"

namespace {

using namespace tunica;
using test::CoupledTube;
using test::SmallTube;

TEUCHOS_UNIT_TEST(coupled_problem, jacobian_is_the_derivative_on_a_fixed_domain) {
  CoupledTube both("extrapolated");
  TEST_ASSERT(both.problem.begin_step(stepping::Clock(0.125, 1)).is_success());
  const auto x = both.point(1);
  for (int direction = 2; direction < 5; ++direction)
    TEST_COMPARE(test::jacobian_error(both.problem, x, both.point(direction), 1e-5), <, 1e-7);
}

TEUCHOS_UNIT_TEST(coupled_problem, jacobian_is_the_derivative_where_the_domain_follows) {
  for (const bool knows : {true, false}) {
    CoupledTube both(knows ? "newton" : "quasi");
    TEST_ASSERT(both.problem.begin_step(stepping::Clock(0.125, 1)).is_success());
    const auto x = both.point(1);
    for (int direction = 2; direction < 5; ++direction) {
      const double error = test::jacobian_error(both.problem, x, both.point(direction), 1e-5);
      if (knows)
        TEST_COMPARE(error, <, 1e-7)
      else
        TEST_COMPARE(error, >, 1e-5);
    }
  }
}

TEUCHOS_UNIT_TEST(coupled_problem, jacobian_does_not_hang_on_what_was_evaluated_before) {
  CoupledTube both("newton");
  TEST_ASSERT(both.problem.begin_step(stepping::Clock(0.125, 1)).is_success());
  const auto x = both.point(1), elsewhere = both.point(2), v = both.point(3);
  algebra::BlockVector F(both.problem.space()), expected(F.space()), found(F.space());
  TEST_ASSERT(both.problem.residual(x, F).is_success());
  both.problem.jacobian(x);
  both.problem.apply_jacobian(v, expected);
  TEST_ASSERT(both.problem.residual(elsewhere, F).is_success());
  both.problem.jacobian(x);
  both.problem.apply_jacobian(v, found);
  for (int b = 0; b < found.n_blocks(); ++b) {
    const double size = expected[b].norm2();
    found[b].update(-1.0, expected[b], 1.0);
    TEST_COMPARE(size, >, 0.0);
    TEST_COMPARE(found[b].norm2(), <=, 1e-13 * size);
  }
}

// The rim of the openings moves, so that areas, flows and the windkessel's pressure do.
TEUCHOS_UNIT_TEST(coupled_problem, jacobian_is_the_derivative_where_ends_slide) {
  CoupledTube both("newton", "held");
  TEST_ASSERT(both.problem.begin_step(stepping::Clock(0.125, 1)).is_success());
  const auto x = both.point(1, true);
  for (int direction = 2; direction < 5; ++direction)
    TEST_COMPARE(test::jacobian_error(both.problem, x, both.point(direction, true), 1e-5), <, 1e-7);
}

TEUCHOS_UNIT_TEST(coupled_problem, momentum_of_both_fields_adds_up_on_the_interface) {
  CoupledTube both("extrapolated");
  TEST_ASSERT(both.problem.begin_step(stepping::Clock(0.125, 1)).is_success());
  algebra::BlockVector F(both.problem.space());
  const auto x = both.point(1);
  TEST_ASSERT(both.problem.residual(x, F).is_success());
  // The fields at the same point, by their own equations: d = Δt y from rest.
  const double dt = 1.0 / both.fluid.time_scheme().rate();
  algebra::BlockVector u(both.fluid.space()), d(both.wall.space());
  algebra::BlockVector of_fluid(u.space()), of_wall(d.space());
  const auto set = [&](const fields::FieldMesh& mesh, double unit, Vector& values) {
    const auto view = values.getLocalViewHost(Tpetra::Access::OverwriteAll);
    for (int a = 0; a < mesh.n_owned; ++a)
      for (int i = 0; i < 3; ++i)
        view(3 * a + i, 0) = CoupledTube::is_held(mesh.x[a])
                                 ? 0.0
                                 : unit * 0.1 * test::scatter(1000.0 + 4.0 * mesh.vertex[a] + i);
  };
  set(both.tube.fluid, 1.0, u[0]);
  set(both.tube.wall, dt, d[0]);
  // Pressures do not act on the sums below: both have a mean that the surface takes.
  TEST_ASSERT(both.fluid.residual(u, of_fluid).is_success() &&
              both.wall.residual(d, of_wall).is_success());
  algebra::BlockVector y(both.problem.space()), sum(both.problem.space());
  y[0].assign(x[0]);
  TEST_ASSERT(both.problem.residual(y, sum).is_success());
  const auto total = sum[0].getLocalViewHost(Tpetra::Access::ReadOnly);
  const auto one = of_fluid[0].getLocalViewHost(Tpetra::Access::ReadOnly);
  const auto other = of_wall[0].getLocalViewHost(Tpetra::Access::ReadOnly);
  std::map<int, int> node_of;
  for (int a = 0; a < both.mesh.n_owned; ++a) node_of[both.mesh.vertex[a]] = a;
  double error = 0.0, size = 0.0;
  for (int k = 0; k < both.interface.n_owned(); ++k) {
    const int f = both.interface.fluid_nodes[k], w = both.interface.wall_nodes[k];
    const int a = node_of.at(both.tube.fluid.vertex[f]);
    for (int i = 0; i < 3; ++i) {
      error =
          std::max(error, std::abs(total(3 * a + i, 0) - one(3 * f + i, 0) - other(3 * w + i, 0)));
      size = std::max(size, std::abs(total(3 * a + i, 0)));
    }
  }
  TEST_COMPARE(global_max(*both.mesh.comm, error), <=, 1e-13 * global_max(*both.mesh.comm, size));
  TEST_COMPARE(global_max(*both.mesh.comm, size), >, 0.0);
}

TEUCHOS_UNIT_TEST(coupled_problem, ranks_agree_with_one) {
  CoupledTube all("quasi"), one("quasi", "clamped", test::alone());
  const stepping::Clock clock(0.125, 1);
  for (CoupledTube* both : {&all, &one}) {
    TEST_ASSERT(both->problem.begin_step(clock).is_success());
    const auto solution = both->problem.solve(both->fluid.state(), both->wall.state(), false);
    TEST_ASSERT(solution.is_taken && solution.newton.is_converged);
    TEST_COMPARE(solution.newton.steps.size(), <=, 8);
    TEST_ASSERT(both->problem.accept().is_success());
  }
  const std::size_t n = all.tube.mesh.vertices.size();
  const auto u = test::by_vertex(all.tube.fluid, all.fluid.state(), n);
  const auto v = test::by_vertex(one.tube.fluid, one.fluid.state(), n);
  TEST_COMPARE(test::largest_difference(u, v), <, 1e-9);
  double largest = 0.0;
  for (const double value : v) largest = std::max(largest, std::abs(value));
  TEST_COMPARE(largest, >, 1e-3);
}

/// Nodes of the outer surface between the clamped ends move along as one.
algebra::BlockVector with_outside_as_one(const CoupledTube& both, algebra::BlockVector x,
                                         const Vec3& y) {
  const auto values = x[0].getLocalViewHost(Tpetra::Access::ReadWrite);
  for (int a = 0; a < both.mesh.n_owned; ++a)
    if (both.mesh.is_on(a, both.tube.surface("outer")) && !CoupledTube::is_held(both.mesh.x[a]))
      for (int i = 0; i < 3; ++i) values(3 * a + i, 0) = y[i];
  return x;
}

// In units of the whole, with numbers of its nodes, beside a windkessel.
TEUCHOS_UNIT_TEST(coupled_problem, jacobian_knows_what_moves_as_one) {
  CoupledTube both("extrapolated", "clamped", test::world(), "moves as one");
  TEST_ASSERT(both.problem.begin_step(stepping::Clock(0.125, 1)).is_success());
  TEST_EQUALITY(both.wall.products()->rank(), 6);
  const auto x = with_outside_as_one(both, both.point(1), {0.03, -0.02, 0.05});
  for (int direction = 2; direction < 5; ++direction) {
    const double unit = 0.1 * direction;
    const auto v = with_outside_as_one(both, both.point(direction), {unit, 0.2, -unit});
    TEST_COMPARE(test::jacobian_error(both.problem, x, v, 1e-5), <, 1e-7);
  }
}

TEUCHOS_UNIT_TEST(coupled_problem, nodes_of_the_interface_cannot_move_as_one) {
  TEST_THROW(CoupledTube("quasi", "moves as one"), Error);
}

}  // namespace
