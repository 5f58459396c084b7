#include <Teuchos_UnitTestHarness.hpp>

#include "small_tube.hpp"
#include "tunica/fields/state.hpp"

namespace {

using namespace tunica;
using fields::Places;
using test::SmallTube;

/// Of width 2 and so many points at each of the places, told from their numbers.
template <class Numbers>
std::vector<double> rows_at(const Numbers& numbers, int points) {
  std::vector<double> rows;
  for (const auto number : numbers)
    for (int k = 0; k < 2 * points; ++k) rows.push_back(test::scatter(10.0 * double(number) + k));
  return rows;
}

/// Owned rows are all that is kept, and bring back those of ghosts.
bool comes_back(const Places& places, const std::vector<double>& rows) {
  fields::State state = places.state();
  state.arrays["x"] = places.owned_rows(rows, 2);
  return places.local_rows(state, "x", 2) == rows;
}

TEUCHOS_UNIT_TEST(places, ghosts_get_the_rows_of_their_owners) {
  const SmallTube tube;
  const fields::FieldMesh& wall = tube.wall;
  const Places nodes = Places::nodes(wall), elements = Places::elements(wall, 4);
  TEST_EQUALITY(nodes.count(), wall.n_nodes());
  TEST_EQUALITY(elements.count(), 4 * static_cast<int>(wall.tets.size()));
  TEST_ASSERT(comes_back(nodes, rows_at(wall.vertex, 1)));
  TEST_ASSERT(comes_back(elements, rows_at(wall.tet_number, 4)));
}

TEUCHOS_UNIT_TEST(places, each_is_owned_once) {
  const SmallTube tube;
  const auto total = [&](const Places& places) {
    return global_sum(*tube.wall.comm, static_cast<double>(places.state().places.size()));
  };
  const SmallTube whole(test::alone());
  TEST_EQUALITY(total(Places::nodes(tube.wall)), whole.wall.n_nodes());
  TEST_EQUALITY(total(Places::owned_nodes(tube.wall)), whole.wall.n_nodes());
  TEST_EQUALITY(total(Places::elements(tube.wall)), double(whole.wall.tets.size()));
  TEST_ASSERT(Places::everywhere().state().places.empty());
}

}  // namespace
