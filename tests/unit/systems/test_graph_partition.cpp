#include <Teuchos_UnitTestHarness.hpp>

#include "helpers.hpp"
#include "tunica/base/reduce.hpp"
#include "tunica/systems/graph_partition.hpp"

namespace {

using namespace tunica;
using namespace tunica::systems_tests;

/// Points of a square, each with those beside it.
systems::NodeGraph square(int side) {
  systems::NodeGraph graph = systems::empty_matrix(side * side, side * side, world());
  for (std::size_t i = 0; i < graph.n_local_rows(); ++i) {
    const auto node = graph.first_row() + static_cast<long long>(i);
    const auto x = node % side, y = node / side;
    if (y > 0) graph.columns.push_back(node - side);
    if (x > 0) graph.columns.push_back(node - 1);
    graph.columns.push_back(node);
    if (x + 1 < side) graph.columns.push_back(node + 1);
    if (y + 1 < side) graph.columns.push_back(node + side);
    graph.start[i + 1] = graph.columns.size();
  }
  return graph;
}

/// Edges between parts.
long long cut(const systems::NodeGraph& graph, const std::vector<int>& parts) {
  const systems::Fetched<int> part(*graph.comm, columns_of(graph), parts, graph.n_rows);
  long long twice = 0;
  for (std::size_t i = 0; i < graph.n_local_rows(); ++i)
    for (std::size_t k = graph.start[i]; k < graph.start[i + 1]; ++k)
      twice += part(graph.columns[k]) != parts[i];
  return global_sum(*graph.comm, twice) / 2;
}

TEUCHOS_UNIT_TEST(graph_partition, parts_are_equal_and_touch_in_few_edges_whoever_cuts) {
  constexpr int side = 24;
  const systems::NodeGraph graph = square(side);
  const int ranks = world()->getSize();
  for (const long long most_for_metis : {0LL, systems::most_edges_for_metis}) {
    const std::vector<int> parts = systems::partition_graph(graph, most_for_metis);
    std::vector<double> sizes(static_cast<std::size_t>(ranks), 0.0);
    for (const int part : parts) sizes.at(static_cast<std::size_t>(part)) += 1.0;
    for (const double size : global_sum(*world(), sizes))
      TEST_COMPARE(std::abs(size * ranks / (side * side) - 1.0), <, 0.1);
    TEST_COMPARE(cut(graph, parts), <=, 2 * side * (ranks - 1));
    TEST_COMPARE_ARRAYS(parts, systems::partition_graph(graph, most_for_metis));
  }
}

TEUCHOS_UNIT_TEST(graph_partition, as_many_parts_as_nodes_are_the_most) {
  const int ranks = world()->getSize();
  const auto of_ranks = systems::empty_matrix(ranks, ranks, world());
  for (const long long most_for_metis : {-1LL, 0LL})  // without an edge
    TEST_EQUALITY(systems::partition_graph(of_ranks, most_for_metis).size(), 1U);
  const auto of_fewer = systems::empty_matrix(ranks - 1, ranks - 1, world());
  TEST_ASSERT(says(refusal([&] { systems::partition_graph(of_fewer); }), "Use fewer ranks"));
}

}  // namespace
