#include <Teuchos_UnitTestHarness.hpp>

#include "tunica/base/error.hpp"
#include "tunica/base/reduce.hpp"
#include "tunica/problems/solid_problem.hpp"
#include "unit/problems/lists.hpp"

namespace {

using namespace tunica;
using problems::SolidProblem;
using test::SmallTube;

constexpr double beta = 0.5, tau = 40.0;

/// A tube under pressure without inertia, with all layers of c10 [kPa].
Teuchos::ParameterList tube_list(double c10, double viscous_fraction) {
  Teuchos::ParameterList list = test::wall_list();
  for (const std::string layer : {"media", "adventitia"})
    list.sublist("Layers")
        .sublist(layer)
        .set("law", std::string("neo-hookean"))
        .set("c10", c10)
        .set("density", 1e-6)
        .set("bulk modulus", 600.0)
        .set("viscous fraction", viscous_fraction)
        .set("relaxation time", tau);
  list.set("time scheme", std::string("implicit euler"));
  list.set("stabilisation", std::string("inertial"));
  test::condition(list, "struct_in", "clamped");
  test::condition(list, "struct_out", "clamped");
  test::condition(list, "interface", "pressure").set("pressure", 1.0);
  list.sublist("Newton").set("relative increment", 0.0).set("absolute increment", 1e-12);
  return test::resolved(list, problems::solid_table());
}

void step(SolidProblem& wall, const stepping::Clock& clock) {
  wall.begin_step(clock);
  const auto report = wall.solve();
  TUNICA_CHECK(report.is_converged, report.reason);
  wall.end_step();
}

double largest(const SolidProblem& wall) {
  double mine = 0.0;
  for (const Vec3& d : wall.displacement()) mine = std::max(mine, norm(d));
  return global_max(*wall.mesh().comm, mine);
}

/// Largest displacement behind so many steps.
double after(const Teuchos::ParameterList& list, double dt, int n) {
  const SmallTube tube;
  SolidProblem wall(list, tube.wall);
  for (stepping::Clock clock(dt, n); !clock.is_done(); clock.advance()) step(wall, clock);
  return largest(wall);
}

TEUCHOS_UNIT_TEST(viscoelastic_wall, creeps_from_the_stiff_wall_to_the_soft_one) {
  const double soft = after(tube_list(30.0, 0.0), 1.0, 2);
  const double stiff = after(tube_list(30.0 * (1.0 + beta), 0.0), 1.0, 2);
  TEST_COMPARE(stiff, <, 0.8 * soft);
  TEST_FLOATING_EQUALITY(after(tube_list(30.0, beta), 0.02, 1), stiff, 1e-3);
  // PSPG goes by the stiffness of a sudden stretch
  TEST_FLOATING_EQUALITY(after(tube_list(30.0, beta), 0.5 * tau, 40), soft, 5e-3);
  const double between = after(tube_list(30.0, beta), 0.1 * tau, 5);
  TEST_COMPARE(between, >, 1.05 * stiff);
  TEST_COMPARE(between, <, 0.95 * soft);
}

TEUCHOS_UNIT_TEST(viscoelastic_wall, jacobian_is_the_derivative_of_the_residual) {
  const SmallTube tube;
  SolidProblem wall(tube_list(30.0, beta), tube.wall);
  const stepping::Clock first(4.0, 2);
  step(wall, first);
  stepping::Clock second = first;
  second.advance();
  wall.begin_step(second);
  const std::vector<int> fixed{tube.surface("struct_in"), tube.surface("struct_out")};
  const auto x = test::free_part(tube.wall, test::scattered(wall, 1, 0.005), fixed);
  const auto v = test::free_part(tube.wall, test::scattered(wall, 2), fixed);
  TEST_COMPARE(test::jacobian_error(wall, x, v, 1e-6), <, 1e-6);
}

TEUCHOS_UNIT_TEST(viscoelastic_wall, goes_on_from_a_saved_state_and_takes_steps_back) {
  const SmallTube tube;
  SolidProblem wall(tube_list(30.0, beta), tube.wall), other(tube_list(30.0, beta), tube.wall);
  stepping::Clock clock(5.0, 3);
  step(wall, clock);
  const fields::State state = wall.save();
  std::map<std::string, fields::State> inner;
  for (const auto& [name, part] : wall.inner_parts()) inner[name] = part->save();
  TEST_ASSERT(inner.count("laws") == 1);
  const auto put_back = [&](SolidProblem& to) {
    to.restore(state);
    for (const auto& [name, part] : to.inner_parts()) part->restore(inner.at(name));
  };
  clock.advance();
  step(wall, clock);
  const std::vector<Vec3> expected = wall.displacement();
  put_back(wall);
  put_back(other);
  step(wall, clock);
  step(other, clock);
  TEST_ASSERT(wall.displacement() == expected);
  TEST_ASSERT(other.displacement() == expected);
}

TEUCHOS_UNIT_TEST(viscoelastic_wall, that_has_settled_begins_without_a_jolt) {
  const SmallTube tube;
  SolidProblem wall(tube_list(30.0, beta), tube.wall);
  stepping::Clock clock(0.5 * tau, 41);
  for (int k = 0; k < 40; ++k, clock.advance()) step(wall, clock);
  const double at_rest = largest(wall);
  SolidProblem other(tube_list(30.0, beta), tube.wall);
  other.take(wall.state());
  other.field().settle(other.state());
  step(other, stepping::Clock(1.0, 1));
  TEST_FLOATING_EQUALITY(largest(other), at_rest, 1e-3);
}

}  // namespace
