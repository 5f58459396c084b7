#include <Teuchos_UnitTestHarness.hpp>

#include "tunica/smoothers/node_ilu/fill_graph.hpp"

namespace {

using namespace tunica;

/// Node 0 beside all others, which are coupled with nothing else: to eliminate it couples all.
smoothers::RowGraph star(int n) {
  smoothers::RowGraph graph;
  for (int i = 0; i < n; ++i) {
    if (i > 0) graph.columns.push_back(0);
    for (int j = i; j < (i == 0 ? n : i + 1); ++j) graph.columns.push_back(j);
    graph.start.push_back(graph.columns.size());
  }
  return graph;
}

TEUCHOS_UNIT_TEST(with_fill, fills_what_elimination_couples) {
  const auto filled = smoothers::with_fill(star(9), 1, 81);
  TEST_ASSERT(filled.has_value());
  TEST_EQUALITY(filled->columns.size(), 81u);
  TEST_EQUALITY(smoothers::with_fill(star(9), 0, 81)->columns.size(), star(9).columns.size());
}

TEUCHOS_UNIT_TEST(with_fill, ends_where_it_is_too_much) {
  TEST_ASSERT(!smoothers::with_fill(star(9), 1, 80).has_value());
  // The work ends with the room: all of this would be 10¹⁰ entries.
  TEST_ASSERT(!smoothers::with_fill(star(100000), 1, 1000000).has_value());
}

}  // namespace
