#include <Teuchos_UnitTestHarness.hpp>
#include <algorithm>
#include <set>

#include "tunica/fields/block_operator.hpp"
#include "unit/algebra/by_blocks.hpp"
#include "unit/fields/small_tube.hpp"

namespace {

using namespace tunica;
using test::SmallTube;

double entry(int v, int i, int w, int j) {
  return test::scatter(1e3 * v + 10.0 * w + 4.0 * i + j + 0.1 * v);
}

/// Replaces every entry by entry() of its vertices and components, through Tpetra's global
/// interface.
void fill(fields::BlockOperator& K, const fields::FieldMesh& mesh) {
  const auto graph = fields::make_node_graph(mesh);
  K.begin_assembly();
  for (int a = 0; a < mesh.n_owned; ++a)
    for (int i = 0; i < 4; ++i)
      for (std::size_t k = graph.row_start[a]; k < graph.row_start[a + 1]; ++k)
        for (int j = 0; j < 4; ++j) {
          const int b = graph.columns[k];
          const GlobalOrdinal row = 4 * mesh.ghosted_map->getGlobalElement(a) + i;
          const GlobalOrdinal column = 4 * mesh.ghosted_map->getGlobalElement(b) + j;
          K.merged()->replaceGlobalValues(
              row, Teuchos::tuple<GlobalOrdinal>(column),
              Teuchos::tuple<double>(entry(mesh.vertex[a], i, mesh.vertex[b], j)));
        }
  K.end_assembly();
}

TEUCHOS_UNIT_TEST(node_graph, rows_hold_the_neighbours_in_ascending_order) {
  const SmallTube tube;
  const auto graph = fields::make_node_graph(tube.fluid);
  std::vector<std::set<int>> neighbours(tube.mesh.vertices.size());
  for (std::size_t e = 0; e < tube.mesh.tets.size(); ++e)
    if (tube.mesh.tet_region[e] == 0)
      for (const int v : tube.mesh.tets[e])
        neighbours[v].insert(tube.mesh.tets[e].begin(), tube.mesh.tets[e].end());
  TEST_EQUALITY(static_cast<int>(graph.row_start.size()), tube.fluid.n_owned + 1);
  for (int a = 0; a < tube.fluid.n_owned; ++a) {
    const auto first = graph.columns.begin() + graph.row_start[a];
    const auto last = graph.columns.begin() + graph.row_start[a + 1];
    TEST_ASSERT(std::is_sorted(first, last));
    std::set<int> found;
    for (auto b = first; b != last; ++b) found.insert(tube.fluid.vertex[*b]);
    TEST_ASSERT(found == neighbours[tube.fluid.vertex[a]]);
  }
}

TEUCHOS_UNIT_TEST(node_graph, elements_find_their_pairs) {
  const SmallTube tube;
  const auto graph = fields::make_node_graph(tube.wall);
  TEST_EQUALITY(graph.position.size(), tube.wall.tets.size());
  for (std::size_t e = 0; e < tube.wall.tets.size(); ++e)
    for (int a = 0; a < 4; ++a)
      for (int b = 0; b < 4; ++b) {
        const int row = tube.wall.tets[e][a], k = graph.position[e][4 * a + b];
        if (row < tube.wall.n_owned)
          TEST_EQUALITY(graph.columns[graph.row_start[row] + k], tube.wall.tets[e][b])
        else
          TEST_EQUALITY(k, -1)
      }
}

TEUCHOS_UNIT_TEST(block_operator, apply_is_the_product_with_the_whole_matrix) {
  const SmallTube tube;
  fields::BlockOperator K(tube.fluid);
  fill(K, tube.fluid);
  const auto x = test::scattered(tube.fluid, 1);
  auto y = test::scattered(tube.fluid, 2);  // overwritten
  K.apply(x, y);

  const std::size_t n = tube.mesh.vertices.size();
  const std::vector<double> all_x = test::by_vertex(tube.fluid, x, n);
  std::set<std::pair<int, int>> pairs;
  for (std::size_t e = 0; e < tube.mesh.tets.size(); ++e)
    if (tube.mesh.tet_region[e] == 0)
      for (const int v : tube.mesh.tets[e])
        for (const int w : tube.mesh.tets[e]) pairs.insert({v, w});
  std::vector<double> expected(4 * n, 0.0);
  for (const auto& [v, w] : pairs)
    for (int i = 0; i < 4; ++i)
      for (int j = 0; j < 4; ++j) expected[4 * v + i] += entry(v, i, w, j) * all_x[4 * w + j];
  TEST_COMPARE(test::largest_difference(test::by_vertex(tube.fluid, y, n), expected), <, 1e-12);
}

TEUCHOS_UNIT_TEST(block_operator, blocks_are_those_of_the_matrix_whatever_its_values_become) {
  const SmallTube tube;
  fields::BlockOperator K(tube.wall);
  const auto x = test::scattered(tube.wall, 1);
  algebra::BlockVector y(K.space());
  TEST_EQUALITY(test::norm(test::product_of_blocks(K, x)),
                0.0);  // asked for before there are values
  fill(K, tube.wall);
  K.apply(x, y);
  TEST_COMPARE(test::norm(y), >, 1.0);
  TEST_COMPARE(test::relative_difference(test::product_of_blocks(K, x), y), <, 1e-14);
}

TEUCHOS_UNIT_TEST(block_operator, elements_find_their_pairs_also_where_scalars_jump) {
  const SmallTube tube;
  std::vector<int> part(tube.mesh.regions.size(), 0);
  part.back() = 1;  // the outer layer
  const auto split = fields::split_mesh(tube.wall, part);
  const fields::BlockOperator K(tube.wall, fields::mixed_blocks, split.get());
  const auto graph = K.merged()->getLocalMatrixHost().graph;
  const Map& columns = *K.merged()->getColMap();
  const auto number = [&](int block, int node) {
    return 4 * K.mesh_of(block).ghosted_map->getGlobalElement(node) + (block == 0 ? 0 : 3);
  };
  for (std::size_t e = 0; e < tube.wall.tets.size(); ++e)
    for (int r = 0; r < 2; ++r)
      for (int c = 0; c < 2; ++c) {
        const auto places = K.places(e, r, c);
        for (int a = 0; a < 4; ++a) {
          const int row = K.mesh_of(r).tets[e][a];
          if (row >= K.mesh_of(r).n_owned) continue;
          for (int b = 0; b < 4; ++b) {
            const int column = K.mesh_of(c).tets[e][b];
            const std::size_t k = K.rows(r).start[row] + places(a, b);
            TEST_EQUALITY(columns.getGlobalElement(graph.entries(k)), number(c, column));
            if (r == 0 && c == 0) TEST_EQUALITY(K.place(row, column), places(a, b));
          }
        }
      }
}

}  // namespace
