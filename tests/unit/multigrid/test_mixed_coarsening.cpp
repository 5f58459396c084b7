#include <Teuchos_UnitTestHarness.hpp>

#include "tunica/base/reduce.hpp"
#include "tunica/base/trilinos.hpp"
#include "tunica/multigrid/coarsening/mixed_coarsening.hpp"
#include "unit/fields/small_tube.hpp"
#include "unit/multigrid/grid_blocks.hpp"

namespace {

using namespace tunica;
using multigrid::MixedCoarsening;
using test::Grid;
using test::row_of;

long long columns(const CrsMatrix& A) { return static_cast<long long>(A.getGlobalNumCols()); }

/// The entries of a row with the numbers that f gives its columns.
template <class Renumber>
std::map<GlobalOrdinal, Scalar> renumbered(const CrsMatrix& P, GlobalOrdinal row, Renumber f) {
  std::map<GlobalOrdinal, Scalar> found;
  for (const auto& [column, weight] : row_of(P, row)) found[f(column)] = weight;
  return found;
}

/// The same without some rows and columns.
Teuchos::RCP<CrsMatrix> without(const CrsMatrix& A, bool (*is_dropped)(GlobalOrdinal)) {
  std::vector<GlobalOrdinal> numbers;
  for (const GlobalOrdinal row : global_numbers(*A.getRowMap()))
    if (!is_dropped(row)) numbers.push_back(row);
  const auto unknown = Teuchos::OrdinalTraits<Tpetra::global_size_t>::invalid();
  const Teuchos::RCP<const Map> map =
      Teuchos::rcp(new Map(unknown, Teuchos::arrayViewFromVector(numbers), 0, A.getComm()));
  const auto rest = Teuchos::rcp(new CrsMatrix(map, longest_local_row(A)));
  for (const GlobalOrdinal row : numbers)
    for (const auto& [column, value] : row_of(A, row))
      if (!is_dropped(column))
        rest->insertGlobalValues(row, Teuchos::tuple<GlobalOrdinal>(column),
                                 Teuchos::tuple<Scalar>(value));
  rest->fillComplete();
  return rest;
}

/// The same with other numbers.
Teuchos::RCP<CrsMatrix> shifted(const CrsMatrix& A, GlobalOrdinal by) {
  std::vector<GlobalOrdinal> numbers;
  for (const GlobalOrdinal row : global_numbers(*A.getRowMap())) numbers.push_back(row + by);
  const auto unknown = Teuchos::OrdinalTraits<Tpetra::global_size_t>::invalid();
  const Teuchos::RCP<const Map> map =
      Teuchos::rcp(new Map(unknown, Teuchos::arrayViewFromVector(numbers), 0, A.getComm()));
  const auto result = Teuchos::rcp(new CrsMatrix(map, longest_local_row(A)));
  for (const GlobalOrdinal row : global_numbers(*A.getRowMap()))
    for (const auto& [column, value] : row_of(A, row))
      result->insertGlobalValues(row + by, Teuchos::tuple<GlobalOrdinal>(column + by),
                                 Teuchos::tuple<Scalar>(value));
  result->fillComplete();
  return result;
}

Teuchos::RCP<const Map> map_of(const algebra::BlockMatrix& K, int block) {
  return (*K.space())[block].map;
}

TEUCHOS_UNIT_TEST(mixed_coarsening,
                  blocks_on_the_same_nodes_repeat_the_prolongator_of_one_unknown) {
  for (const int components : {2, 3}) {
    const auto K = test::blocks_on({9, 7, 5, true}, test::world(), components);
    MixedCoarsening coarsening(*K.space());
    const int dofs = components + 1;
    Teuchos::RCP<const Map> nodes = map_of(K, 1), vectors = map_of(K, 0);
    Teuchos::RCP<const Map> both = algebra::DofLayout(*K.space()).merged_map(*K.space());
    for (int level = 0; nodes->getGlobalNumElements() > 1; ++level) {
      const auto P = coarsening.prolongator(level, *nodes);
      const auto Pu = coarsening.prolongator(level, *vectors);
      const auto all = coarsening.prolongator(level, *both);
      bool is_repeated = true;
      for (const GlobalOrdinal row : global_numbers(*P->getRowMap())) {
        for (int i = 0; i < components; ++i)
          is_repeated &= row_of(*Pu, components * row + i) ==
                         renumbered(*P, row, [&](auto node) { return components * node + i; });
        for (int i = 0; i < dofs; ++i)
          is_repeated &= row_of(*all, dofs * row + i) ==
                         renumbered(*P, row, [&](auto node) { return dofs * node + i; });
      }
      TEST_ASSERT(all_agree(*test::world(), is_repeated));
      nodes = P->getDomainMap();
      vectors = Pu->getDomainMap();
      both = all->getDomainMap();
      TEST_EQUALITY(columns(*all), dofs * columns(*P));
    }
  }
}

TEUCHOS_UNIT_TEST(mixed_coarsening, nodes_of_the_last_part_are_those_between_fields) {
  const Grid grid{9, 7, 5, true};
  const auto A = grid.laplacian(test::world(), 3);
  algebra::Nodes nodes = test::nodes_of(grid.graph(test::world()));
  const auto parts = Teuchos::rcp(new Vector(nodes.graph->getRowMap()));
  const auto flags = Teuchos::rcp(new Vector(nodes.graph->getRowMap()));
  for (const GlobalOrdinal node : global_numbers(*nodes.graph->getRowMap())) {
    const GlobalOrdinal z = node / (grid.nx * grid.ny);
    parts->replaceGlobalValue(node, z < 3 ? 0.0 : z > 3 ? 1.0 : 2.0);
    flags->replaceGlobalValue(node, z == 3 ? 1.0 : 0.0);
  }
  nodes.parts = parts;
  const auto C = nodes.graph->getRowMap();
  MixedCoarsening coarsening(
      algebra::BlockSpace({{"vector", A->getRowMap(), 3, nodes}, {"scalar", C, 1, nodes}},
                          {"below", "above", "plane"}));
  multigrid::NodalCoarsening expected(nodes.graph, *nodes.order, flags),
      without(nodes.graph, *nodes.order);
  Teuchos::RCP<const Map> rows = C;
  for (int level = 0; level < 3; ++level) {
    const auto P = coarsening.prolongator(level, *rows), of_nodes = expected.prolongator(level);
    bool is_same = P->getDomainMap()->isSameAs(*of_nodes->getDomainMap());
    for (const GlobalOrdinal row : global_numbers(*rows))
      is_same &= row_of(*P, row) == row_of(*of_nodes, row);
    TEST_ASSERT(all_agree(*test::world(), is_same));
    rows = P->getDomainMap();
  }
  TEST_INEQUALITY(columns(*coarsening.prolongator(0, *C)), columns(*without.prolongator(0)));
}

TEUCHOS_UNIT_TEST(mixed_coarsening, rows_of_blocks_on_different_nodes_are_those_of_each) {
  const Grid fine{9, 9, 5, true};
  const auto K = test::two_blocks(fine.laplacian(test::world(), 3), 3,
                                  test::nodes_of(fine.graph(test::world())),
                                  Grid{5, 5, 3, true}.laplacian(test::world()));
  MixedCoarsening coarsening(*K.space());
  Teuchos::RCP<const Map> nodes = map_of(K, 1), vectors = map_of(K, 0);
  Teuchos::RCP<const Map> both = algebra::DofLayout().merged_map(*K.space());
  for (int level = 0; level < 2; ++level) {
    const auto Pu = coarsening.prolongator(level, *vectors);
    const auto Pp = coarsening.prolongator(level, *nodes);
    const auto all = coarsening.prolongator(level, *both);
    bool is_same = true;
    for (const GlobalOrdinal row : global_numbers(*Pu->getRowMap()))
      is_same &= row_of(*all, row / 3 * 4 + row % 3) ==
                 renumbered(*Pu, row, [](auto column) { return column / 3 * 4 + column % 3; });
    for (const GlobalOrdinal row : global_numbers(*Pp->getRowMap()))
      is_same &=
          row_of(*all, 4 * row + 3) == renumbered(*Pp, row, [](auto node) { return 4 * node + 3; });
    TEST_ASSERT(all_agree(*test::world(), is_same));
    nodes = Pp->getDomainMap();
    vectors = Pu->getDomainMap();
    both = all->getDomainMap();
    TEST_EQUALITY(columns(*all), columns(*Pu) + columns(*Pp));
  }
}

bool is_missing(GlobalOrdinal number) { return number % 3 == 1 && number / 3 % 3 == 0; }

TEUCHOS_UNIT_TEST(mixed_coarsening,
                  nodes_that_lack_a_component_interpolate_from_those_that_have_it) {
  const auto whole = test::blocks_on({9, 7, 5, true});
  const auto K = test::two_blocks(without(*whole(0, 0), is_missing), 3, (*whole.space())[0].nodes,
                                  whole(1, 1));
  MixedCoarsening coarsening(*K.space());
  const auto P = coarsening.prolongator(0, *map_of(K, 1));
  const auto Pu = coarsening.prolongator(0, *map_of(K, 0));
  TEST_ASSERT(Pu->getRowMap()->isSameAs(*K(0, 0)->getRowMap()));
  TEST_COMPARE(columns(*Pu), <, 3 * columns(*P));
  Vector ones(Pu->getDomainMap()), sums(Pu->getRangeMap()), reached(Pu->getDomainMap());
  ones.putScalar(1.0);
  Pu->apply(ones, sums);
  long long n_wrong = 0;
  for (const GlobalOrdinal row : global_numbers(*Pu->getRowMap())) {
    const double sum = sums.getData()[Pu->getRowMap()->getLocalElement(row)];
    n_wrong += std::abs(sum - 1.0) > 1e-14 && !row_of(*Pu, row).empty();
  }
  TEST_EQUALITY(global_sum(*test::world(), n_wrong), 0);
  sums.putScalar(1.0);
  Pu->apply(sums, reached, Teuchos::TRANS);
  double least = 1e300;  // no coarse unknown is without a fine one
  for (const double value : reached.getData()) least = std::min(least, value);
  TEST_COMPARE(global_max(*test::world(), -least), <, -0.99);
}

/// As on staggered grids: as many scalars as vectors, elsewhere.
TEUCHOS_UNIT_TEST(mixed_coarsening, blocks_with_as_many_rows_on_different_nodes_are_told_apart) {
  const auto A = Grid{8, 9, 1, false}.laplacian(test::world());
  const auto K = test::two_blocks(A, 1, test::nodes_of(A->getCrsGraph()),
                                  shifted(*Grid{9, 8, 1, true}.laplacian(test::world()), 1000));
  MixedCoarsening coarsening(*K.space());
  TEST_ASSERT(coarsening.prolongator(0, *map_of(K, 0))->getRowMap()->isSameAs(*map_of(K, 0)));
  TEST_ASSERT(coarsening.prolongator(0, *map_of(K, 1))->getRowMap()->isSameAs(*map_of(K, 1)));
}

TEUCHOS_UNIT_TEST(mixed_coarsening, knows_a_mixed_matrix_from_a_block) {
  const auto K = test::blocks_on({4, 4, 4, true});
  MixedCoarsening coarsening(*K.space());
  const auto both = Grid{4, 4, 4, true}.laplacian(test::world(), 4);
  coarsening.check_mixed(0, *both);
  TEST_THROW(coarsening.check_mixed(0, *K(0, 0)), std::runtime_error);
  TEST_THROW(coarsening.check_mixed(0, *K(1, 1)), std::runtime_error);
  TEST_THROW(coarsening.check_mixed(0, *Grid{5, 5, 5, true}.laplacian(test::world(), 3)),
             std::runtime_error);
  TEST_THROW(coarsening.prolongator(0, Map(17, 0, test::world())), std::runtime_error);
}

}  // namespace
