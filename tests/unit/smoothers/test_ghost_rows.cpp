#include <Teuchos_UnitTestHarness.hpp>

#include "tunica/base/trilinos.hpp"
#include "tunica/smoothers/node_ilu/node_ilu.hpp"
#include "unit/algebra/distance.hpp"
#include "unit/fields/small_tube.hpp"

namespace {

using namespace tunica;

/// A chain of nodes with two unknowns, so many on each rank: u between neighbours, p over the next
/// but one, so that rows of a rank reach p of a ghost without its u.
Teuchos::RCP<CrsMatrix> chain(int nodes_of_rank) {
  const CommPtr comm = test::world();
  const GlobalOrdinal n = nodes_of_rank * comm->getSize();
  const Teuchos::RCP<const Map> map = Teuchos::rcp(new Map(2 * n, 2 * nodes_of_rank, 0, comm));
  const auto K = Teuchos::rcp(new CrsMatrix(map, 4));
  for (const GlobalOrdinal row : global_numbers(*map)) {
    const GlobalOrdinal node = row / 2, unknown = row % 2, far = unknown == 0 ? 1 : 2;
    const auto insert = [&](GlobalOrdinal column, double value) {
      K->insertGlobalValues(row, Teuchos::tuple<GlobalOrdinal>(column), Teuchos::tuple(value));
    };
    insert(row, 3.0);
    insert(2 * node + 1 - unknown, 0.5);
    if (node >= far) insert(row - 2 * far, -1.0 - 0.01 * static_cast<double>(node));
    if (node + far < n) insert(row + 2 * far, -1.0);
  }
  K->fillComplete();
  return K;
}

// A sweep from x finds the residuals of ghosts' rows itself; one from zero is given them:
// x + M (b − K x) either way.
TEUCHOS_UNIT_TEST(ghost_rows, their_residuals_are_those_of_their_owners) {
  const auto K = chain(6);
  const auto factors =
      smoothers::make_node_ilu(*K, algebra::DofLayout({1, 1}), {0, smoothers::Precision::full});
  factors->refresh();
  Vector b(K->getRowMap()), x(K->getRowMap());
  b.randomize();
  x.randomize();
  Vector r(b, Teuchos::Copy), move(K->getRowMap()), expected(x, Teuchos::Copy);
  K->apply(x, r, Teuchos::NO_TRANS, -1.0, 1.0);
  factors->smooth_from_zero(1.0, r, move);
  expected.update(1.0, move, 1.0);
  factors->smooth(1.0, b, x);
  TEST_COMPARE(test::largest_distance(x, expected), <, 1e-13);
  // a second sweep, for which only x is fetched
  K->apply(expected, r);
  r.update(1.0, b, -1.0);
  factors->smooth_from_zero(1.0, r, move);
  expected.update(1.0, move, 1.0);
  Vector y(K->getRowMap());
  y.update(1.0, expected, -1.0, move, 0.0);
  factors->sweep({1.0, 1.0}, smoothers::NodeIlu::Start::given, b, y);
  factors->smooth(1.0, b, expected);
  TEST_COMPARE(test::largest_distance(y, expected), <, 1e-13);
}

}  // namespace
