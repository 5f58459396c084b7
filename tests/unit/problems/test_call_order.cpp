#include <Teuchos_UnitTestHarness.hpp>

#include "tunica/problems/fluid_problem.hpp"
#include "tunica/problems/solid_problem.hpp"
#include "unit/multigrid/complaint.hpp"
#include "unit/problems/lists.hpp"

namespace {

using namespace tunica;
using test::SmallTube;

Teuchos::ParameterList tube_of_two_ends() {
  auto list = test::fluid_list(1.0, 3.5e-3);
  test::condition(list, "inlet", "pressure").set("pressure", 1.0);
  test::condition(list, "interface", "no slip");
  return test::resolved(list, problems::fluid_table());
}

Teuchos::ParameterList wall_of_two_ends() {
  auto list = test::wall_list();
  test::condition(list, "struct_in", "clamped");
  test::condition(list, "struct_out", "clamped");
  return test::resolved(list, problems::solid_table());
}

bool names(const std::string& text, const std::string& call) {
  return text.find(call) != std::string::npos;
}

TEUCHOS_UNIT_TEST(call_order, a_fluid_says_what_has_to_come_first) {
  const SmallTube tube;
  problems::FluidProblem fluid(tube_of_two_ends(), tube.fluid);
  algebra::BlockVector F(fluid.space());
  const auto residual = [&] { static_cast<void>(fluid.residual(fluid.state(), F)); };
  const auto jacobian = [&] { fluid.jacobian(fluid.state()); };
  const auto move = [&] {
    const std::vector<Vec3> d(tube.fluid.n_nodes());
    static_cast<void>(fluid.field().set_domain(d, d));
  };
  const auto end = [&] { fluid.end_step(); };
  const std::vector<std::function<void()>> calls{residual, jacobian, end, [&] { fluid.prepare(); }};
  for (const auto& call : calls)
    TEST_ASSERT(names(test::complaint<std::logic_error>(call), "begin_step()"));
  TEST_ASSERT(names(test::complaint<std::logic_error>(move), "begin_step()"));
  fluid.begin_step(stepping::Clock(0.125, 2));
  TEST_ASSERT(names(test::complaint<std::logic_error>(residual), "prescribe()"));
  fluid.prepare();
  residual();
  jacobian();
  move();  // a new domain has other coefficients
  TEST_ASSERT(names(test::complaint<std::logic_error>(jacobian), "prescribe()"));
  fluid.field().fix_coefficients();
  jacobian();
  end();
  move();  // where it was extrapolated, to the wall as it was found
  for (const auto& call : calls)
    TEST_ASSERT(names(test::complaint<std::logic_error>(call), "begin_step()"));
}

TEUCHOS_UNIT_TEST(call_order, a_wall_says_what_has_to_come_first) {
  const SmallTube tube;
  problems::SolidProblem wall(wall_of_two_ends(), tube.wall);
  algebra::BlockVector F(wall.space());
  const std::vector<Vec3> force(tube.wall.n_owned);
  const std::vector<std::function<void()>> calls{
      [&] { static_cast<void>(wall.residual(wall.state(), F)); },
      [&] { wall.jacobian(wall.state()); },
      [&] { static_cast<void>(wall.solve_linearised(force)); }, [&] { wall.end_step(); }};
  for (int step = 0; step < 2; ++step) {
    for (const auto& call : calls)
      TEST_ASSERT(names(test::complaint<std::logic_error>(call), "begin_step()"));
    wall.begin_step(stepping::Clock(0.125, 2));
    for (const auto& call : calls) call();  // the last one ends it
  }
}

}  // namespace
