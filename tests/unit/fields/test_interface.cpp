#include <Teuchos_UnitTestHarness.hpp>

#include "tunica/fields/interface_transfer.hpp"
#include "unit/fields/small_tube.hpp"

namespace {

using namespace tunica;
using test::SmallTube;

TEUCHOS_UNIT_TEST(interface, pairs_are_the_same_vertex_owned_by_the_same_rank) {
  const SmallTube tube;
  const fields::InterfaceTransfer interface(tube.fluid, tube.wall, {tube.surface("interface")});
  TEST_EQUALITY(interface.fluid_nodes.size(), interface.wall_nodes.size());
  for (int k = 0; k < interface.n_owned(); ++k) {
    const int fluid = interface.fluid_nodes[k], wall = interface.wall_nodes[k];
    TEST_EQUALITY(tube.fluid.vertex[fluid], tube.wall.vertex[wall]);
    TEST_ASSERT(fluid < tube.fluid.n_owned && wall < tube.wall.n_owned);
  }
}

TEUCHOS_UNIT_TEST(interface, every_vertex_of_the_inner_surface_is_paired_once) {
  const SmallTube tube;
  const fields::InterfaceTransfer interface(tube.fluid, tube.wall, {tube.surface("interface")});
  TEST_EQUALITY(interface.n_total(), 8 * 4);  // 8 around, 4 along
  TEST_EQUALITY(global_sum(*test::world(), 1.0 * interface.n_owned()), 32.0);
}

TEUCHOS_UNIT_TEST(interface, values_go_to_a_field_and_come_back) {
  const SmallTube tube;
  const fields::InterfaceTransfer interface(tube.fluid, tube.wall, {tube.surface("interface")});
  fields::InterfaceVector values(3 * interface.n_owned());
  for (std::size_t i = 0; i < values.size(); ++i) values[i] = 1.0 + static_cast<double>(i);
  const std::vector<Vec3> fluid = interface.to_fluid(values), wall = interface.to_wall(values);
  TEST_ASSERT(interface.from_fluid(fluid) == values && interface.from_wall(wall) == values);
  double elsewhere = 0.0;
  for (int a = 0; a < tube.wall.n_owned; ++a)
    if (!tube.wall.is_on(a, tube.surface("interface"))) elsewhere += norm(wall[a]);
  TEST_EQUALITY(elsewhere, 0.0);
}

}  // namespace
