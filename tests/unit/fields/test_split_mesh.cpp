#include <Teuchos_UnitTestHarness.hpp>
#include <map>
#include <set>

#include "tunica/fields/split_mesh.hpp"
#include "tunica/fields/state.hpp"
#include "unit/fields/small_tube.hpp"

namespace {

using namespace tunica;
using test::SmallTube;

const std::vector<int> by_region{0, 0, 1};  // fluid, media, adventitia

TEUCHOS_UNIT_TEST(split_mesh, is_not_there_where_all_regions_are_of_one_part) {
  const SmallTube tube;
  TEST_ASSERT(fields::split_mesh(tube.wall, {7, 0, 0}) == nullptr);
  TEST_ASSERT(fields::split_mesh(tube.fluid, by_region) == nullptr);
}

TEUCHOS_UNIT_TEST(split_mesh, has_a_node_for_each_vertex_and_part) {
  const SmallTube tube;
  const auto split = fields::split_mesh(tube.wall, by_region);
  TEST_EQUALITY(split->n_copies, 2);
  TEST_EQUALITY(split->node_map->getGlobalNumElements(),
                tube.wall.node_map->getGlobalNumElements() + 8 * 4);  // around, along
  std::vector<std::set<int>> parts(split->n_nodes());
  for (std::size_t e = 0; e < split->tets.size(); ++e)
    for (int a = 0; a < 4; ++a) {
      const int node = split->tets[e][a];
      TEST_EQUALITY(split->node[node], tube.wall.tets[e][a]);
      parts[node].insert(by_region[split->region[e]]);
    }
  for (int a = 0; a < split->n_nodes(); ++a) {
    TEST_EQUALITY(parts[a].size(), 1);
    if (split->copy[a] == 1) TEST_EQUALITY(*parts[a].begin(), 1);
    TEST_EQUALITY(norm(split->x[a] - tube.wall.x[split->node[a]]), 0.0);
    TEST_EQUALITY(a < split->n_owned, split->node[a] < tube.wall.n_owned);
  }
}

TEUCHOS_UNIT_TEST(split_mesh, keeps_the_numbers_of_the_nodes_and_adds_others_behind) {
  const SmallTube tube;
  const auto split = fields::split_mesh(tube.wall, by_region);
  const auto n = static_cast<GlobalOrdinal>(tube.wall.node_map->getGlobalNumElements());
  for (int a = 0; a < split->n_nodes(); ++a) {
    const GlobalOrdinal number = split->ghosted_map->getGlobalElement(a);
    const int node = split->node[a];
    if (split->copy[a] == 0) {
      TEST_EQUALITY(number, tube.wall.ghosted_map->getGlobalElement(node));
      TEST_EQUALITY(split->vertex[a], tube.wall.vertex[node]);
    } else {
      TEST_COMPARE(number, >=, n);
      TEST_COMPARE(split->vertex[a], >, tube.wall.vertex[node]);
    }
  }
  TEST_ASSERT(split->node_map->isOneToOne());
}

TEUCHOS_UNIT_TEST(split_mesh, is_the_same_on_any_ranks) {
  const SmallTube tube, serial(test::alone());
  const auto split = fields::split_mesh(tube.wall, by_region);
  const auto expected = fields::split_mesh(serial.wall, by_region);
  // A node's part shows in the centres of its elements.
  const auto centres = [](const fields::SplitMesh& mesh) {
    std::map<int, Vec3> sums;
    for (const auto& tet : mesh.tets)
      for (const int a : tet) {
        if (a >= mesh.n_owned) continue;
        for (const int b : tet) sums[mesh.vertex[a]] += mesh.x[b];
      }
    return sums;
  };
  const auto all = centres(*expected);
  for (const auto& [vertex, sum] : centres(*split)) {
    TEST_EQUALITY(all.count(vertex), 1);
    TEST_COMPARE(norm(sum - all.at(vertex)), <, 1e-12);
  }
}

TEUCHOS_UNIT_TEST(split_mesh, faces_are_those_of_the_elements) {
  const SmallTube tube;
  const auto split = fields::split_mesh(tube.wall, by_region);
  TEST_EQUALITY(split->faces.size(), tube.wall.faces.size());
  for (const fields::Face& face : split->faces)
    for (const int a : face.nodes) {
      const auto& tet = split->tets[face.tet];
      TEST_ASSERT(std::find(tet.begin(), tet.end(), a) != tet.end());
      TEST_ASSERT(split->is_on(a, face.surface));
    }
}

TEUCHOS_UNIT_TEST(split_mesh, values_come_back_from_the_rows_of_a_state) {
  const SmallTube tube;
  const auto split = fields::split_mesh(tube.wall, by_region);
  Vector values(split->node_map), back(split->node_map);
  for (int a = 0; a < split->n_owned; ++a)
    values.replaceLocalValue(a, test::scatter(split->vertex[a]));
  fields::State state = fields::state_on(tube.wall);
  state.arrays["pressure"] = fields::rows_of(values, *split);
  fields::assign_rows(state.array("pressure", 2), *split, back);
  back.update(-1.0, values, 1.0);
  TEST_EQUALITY(back.normInf(), 0.0);
}

}  // namespace
