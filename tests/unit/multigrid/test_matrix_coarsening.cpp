#include <MueLu_Hierarchy.hpp>
#include <MueLu_ParameterListInterpreter.hpp>
#include <Teuchos_UnitTestHarness.hpp>

#include "tunica/base/map_of.hpp"
#include "tunica/base/trilinos.hpp"
#include "tunica/multigrid/coarsening/matrix_coarsening.hpp"
#include "tunica/multigrid/muelu/cycle.hpp"
#include "tunica/multigrid/muelu/factory_factory.hpp"
#include "tunica/multigrid/muelu/xpetra.hpp"
#include "unit/algebra/distance.hpp"
#include "unit/fields/small_tube.hpp"
#include "unit/multigrid/complaint.hpp"
#include "unit/multigrid/grid_blocks.hpp"
#include "unit/smoothers/wall_matrix.hpp"

namespace {

using namespace tunica;
using test::columns_of;
using test::Grid;
using test::WallMatrix;
using XVector = Xpetra::TpetraMultiVector<Scalar, LocalOrdinal, GlobalOrdinal, Node>;

TEUCHOS_UNIT_TEST(node_graph, has_the_neighbours_of_the_grid) {
  const Grid grid{4, 3, 3, true};
  const auto nodes =
      multigrid::nodes_of(*grid.laplacian(test::world(), 4), algebra::DofLayout({3, 1}));
  for (const GlobalOrdinal node : global_numbers(*nodes.graph->getRowMap())) {
    auto expected = grid.neighbours(node);
    expected.push_back(node);
    std::sort(expected.begin(), expected.end());
    TEST_COMPARE_ARRAYS(columns_of(*nodes.graph, node), expected);
  }
}

/// Three nodes of two unknowns on each rank; the first of all is coupled to the last, not back.
Teuchos::RCP<CrsMatrix> one_way(GlobalOrdinal left_out = -1) {
  std::vector<GlobalOrdinal> numbers;
  const CommPtr comm = test::world();
  const GlobalOrdinal n = 6 * comm->getSize();
  for (GlobalOrdinal g = 6 * comm->getRank(); g < 6 * (comm->getRank() + 1); ++g)
    if (g != left_out) numbers.push_back(g);
  const auto K = Teuchos::rcp(new CrsMatrix(map_of(numbers, comm), 2));
  for (const GlobalOrdinal g : numbers) {
    K->insertGlobalValues(g, Teuchos::tuple(g), Teuchos::tuple(1.0));
    if (g == 0) K->insertGlobalValues(g, Teuchos::tuple(n - 2), Teuchos::tuple(0.0));
  }
  K->fillComplete();
  return K;
}

TEUCHOS_UNIT_TEST(node_graph, couples_both_ways_whatever_the_values) {
  const auto nodes = multigrid::nodes_of(*one_way(), algebra::DofLayout({1, 1}));
  const GlobalOrdinal last = 3 * test::world()->getSize() - 1;
  for (const GlobalOrdinal node : global_numbers(*nodes.graph->getRowMap())) {
    std::vector<GlobalOrdinal> expected{node};
    if (node == 0) expected = {0, last};
    if (node == last) expected = {0, last};
    TEST_COMPARE_ARRAYS(columns_of(*nodes.graph, node), expected);
  }
}

TEUCHOS_UNIT_TEST(node_graph, a_node_without_scalar_is_refused_on_all_ranks) {
  const auto without_scalar = [] { multigrid::nodes_of(*one_way(3), algebra::DofLayout({1, 1})); };
  const auto text = test::complaint(without_scalar);
  TEST_INEQUALITY(text.find("unknown 2 of node 1"), std::string::npos);
}

TEUCHOS_UNIT_TEST(cycle_of_a_matrix, reduces_as_much_as_that_of_blocks) {
  const WallMatrix wall;
  const auto list = multigrid::mixed_cycle_list(1);
  const auto left = [&](const multigrid::Cycle& cycle) {
    const Vector b = wall.scattered(1);
    Vector x(b.getMap()), r(b, Teuchos::Copy), z(b.getMap());
    for (int k = 0; k < 5; ++k) {
      cycle.apply(r, z);
      x.update(1.0, z, 1.0);
      wall.K()->apply(x, r);
      r.update(1.0, b, -1.0);
    }
    return r.norm2() / b.norm2();
  };
  const double of_matrix = left(multigrid::Cycle(wall.K(), 3, list));
  const double of_blocks = left(multigrid::Cycle(
      wall.K(), Teuchos::rcp(new multigrid::MixedCoarsening(*wall.jacobian.K.space())), list));
  out << "left after 5 cycles: " << of_matrix << ", " << of_blocks << "\n";
  TEST_COMPARE(of_matrix, <, 3.0 * of_blocks);
}

TEUCHOS_UNIT_TEST(cycle_of_a_matrix, is_what_muelu_makes_with_our_factories) {
  const WallMatrix wall;
  auto list = multigrid::mixed_cycle_list(1);
  list.sublist("Hierarchy").set("coarse: max size", 30);
  const Vector b = wall.scattered(1);
  Vector x(b.getMap()), expected(b.getMap());
  multigrid::Cycle(wall.K(), 3, list).apply(b, x);

  MueLu::ParameterListInterpreter<Scalar, LocalOrdinal, GlobalOrdinal, Node> interpreter(
      list, b.getMap()->getComm(),
      multigrid::make_factory_factory(multigrid::make_coarsening(*wall.K(), 3)));
  const auto hierarchy = interpreter.CreateHierarchy();
  hierarchy->GetLevel(0)->Set("A", multigrid::wrapped(wall.K()));
  interpreter.SetupHierarchy(*hierarchy);
  hierarchy->IsPreconditioner(true);
  const XVector from(Teuchos::rcp(new MultiVector(b, Teuchos::Copy)));
  XVector to(Teuchos::rcpFromRef(expected));
  hierarchy->Iterate(from, to, 1, true);
  TEST_COMPARE(hierarchy->GetNumLevels(), >, 1);
  // A cycle's residuals come from the smoother's copy of the matrix, in single precision.
  TEST_COMPARE(test::largest_distance(x, expected), <, 1e-6);
}

}  // namespace
