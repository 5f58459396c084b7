#include "unit/coupling/coupled_tube.hpp"

namespace tunica {

namespace {

Teuchos::ParameterList partitioned() {
  Teuchos::ParameterList list;
  list.set("scheme", std::string("dirichlet-neumann"));
  return test::resolved(list, coupling::coupling_table());
}

/// The wall with a solver that comes nowhere.
problems::SolidProblem weak_wall(const test::CoupledTube& tube) {
  auto list = test::CoupledTube::wall_list("clamped");
  list.remove("Linear Solver");
  list.sublist("Linear Solver")
      .set("preconditioner", std::string("none"))
      .set("max iterations", 1)
      .set("fallbacks", Teuchos::Array<std::string>());
  return {test::resolved(list, problems::solid_table()), tube.tube.wall};
}

TEUCHOS_UNIT_TEST(dirichlet_neumann, keeps_the_compliance_of_the_wall_over_a_restart) {
  test::CoupledTube tube("newton");
  const stepping::Clock clock(0.125, 4);
  const auto scheme = coupling::make_scheme(
      partitioned(), {tube.interface, tube.fluid, tube.wall, tube.motion, nullptr});
  TEST_ASSERT(!scheme->save().has_array("compliance"));
  TEST_ASSERT(scheme->begin_step(clock).is_success());
  const fields::State state = scheme->save();
  TEST_ASSERT(state.has_array("compliance"));

  problems::SolidProblem weak = weak_wall(tube);
  const auto again = coupling::make_scheme(
      partitioned(), {tube.interface, tube.fluid, weak, tube.motion, nullptr});
  TEST_ASSERT(again->begin_step(clock).is_failure());
  again->restore(state);
  TEST_ASSERT(again->begin_step(clock).is_success());
  TEST_ASSERT(again->save().array("compliance", 1).values == state.array("compliance", 1).values);
}

TEUCHOS_UNIT_TEST(scheme, solves_a_step_once_after_it_has_begun) {
  const stepping::Clock clock(0.125, 4);
  for (const std::string geometry : {"newton", "extrapolated"}) {
    test::CoupledTube tube(geometry);
    const auto lists = {partitioned(), test::CoupledTube::coupling_list(geometry)};
    for (const Teuchos::ParameterList& list : lists) {
      const auto scheme = coupling::make_scheme(
          list, {tube.interface, tube.fluid, tube.wall, tube.motion, &tube.mesh});
      const auto solve = [&] { return scheme->solve_step(clock, [](int, const auto&) {}); };
      TEST_THROW(solve(), std::logic_error);
      TEST_ASSERT(scheme->begin_step(clock).is_success());
      TEST_ASSERT(solve().is_accepted);
      TEST_THROW(solve(), std::logic_error);
    }
  }
}

}  // namespace

}  // namespace tunica
