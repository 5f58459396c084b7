#include <Teuchos_UnitTestHarness.hpp>
#include <TpetraExt_MatrixMatrix.hpp>
#include <memory>
#include <set>

#include "tunica/algebra/independent_set.hpp"
#include "tunica/base/trilinos.hpp"
#include "tunica/fields/block_operator.hpp"
#include "tunica/multigrid/coarsening/nodal_coarsening.hpp"
#include "unit/fields/small_tube.hpp"
#include "unit/multigrid/grid_blocks.hpp"

namespace {

using namespace tunica;
using multigrid::NodalCoarsening;
using test::columns_of;
using test::Grid;
using test::row_of;
using test::SmallTube;

const std::vector<Grid> grids{{9, 7, 5, true}, {6, 5, 7, false}, {40, 1, 1, false}};

/// Grids, and the nodes of two meshes, whose numbers hang on the ranks.
std::vector<algebra::Nodes> graphs(const CommPtr& comm = test::world()) {
  std::vector<algebra::Nodes> all;
  for (const Grid& grid : grids) all.push_back((*test::blocks_on(grid, comm).space())[1].nodes);
  const SmallTube tube(comm);
  for (const fields::FieldMesh* mesh : {&tube.fluid, &tube.wall})
    all.push_back((*fields::BlockOperator(*mesh).space())[1].nodes);
  return all;
}

long long n_nodes(NodalCoarsening& coarsening, int level) {
  return static_cast<long long>(coarsening.prolongator(level)->getGlobalNumRows());
}

/// is_first: of nodes that are picked before all others.
template <class IsFirst>
std::vector<char> greedy_set(const Grid& grid, const IsFirst& is_first) {
  std::vector<char> is_coarse(grid.n_nodes(), 0);
  for (const bool turn : {true, false})
    for (GlobalOrdinal node = 0; node < grid.n_nodes(); ++node) {
      if (is_first(node) != turn) continue;
      is_coarse[node] = 1;
      for (const GlobalOrdinal other : grid.neighbours(node))
        if (other != node && is_coarse[other]) is_coarse[node] = 0;
    }
  return is_coarse;
}
std::vector<char> greedy_set(const Grid& grid) {
  return greedy_set(grid, [](GlobalOrdinal) { return true; });
}

/// Per coarse node the node of the finer level that it is, on every rank.
std::vector<GlobalOrdinal> fine_numbers(const CrsGraph& nodes, const CrsMatrix& P,
                                        const std::vector<char>& is_coarse) {
  std::vector<GlobalOrdinal> mine(P.getGlobalNumCols(), 0), all(mine);
  for (const GlobalOrdinal row : global_numbers(*nodes.getRowMap()))
    if (is_coarse[nodes.getColMap()->getLocalElement(row)])
      mine[row_of(P, row).begin()->first] = row;
  Teuchos::reduceAll(*nodes.getComm(), Teuchos::REDUCE_SUM, static_cast<int>(mine.size()),
                     mine.data(), all.data());
  return all;
}

/// Flags of the columns: the nodes that a level keeps. Those of all ranks must be as many as it
/// has.
std::vector<char> kept_nodes(NodalCoarsening& coarsening, const CrsGraph& nodes) {
  Vector flags(nodes.getRowMap());
  for (const int row : coarsening.coarse_rows(0)) flags.replaceLocalValue(row, 1.0);
  const Vector on_all = algebra::on_columns(nodes, flags);
  const auto view = on_all.getLocalViewHost(read_only);
  std::vector<char> kept;
  for (std::size_t c = 0; c < view.extent(0); ++c) kept.push_back(view(c, 0) != 0.0);
  return kept;
}

TEUCHOS_UNIT_TEST(independent_set, is_that_of_a_serial_greedy_pass_on_any_number_of_ranks) {
  for (const Grid& grid : grids) {
    const auto nodes = grid.graph(test::world());
    const auto is_coarse = algebra::independent_set(*nodes, *test::nodes_of(nodes).order);
    const auto expected = greedy_set(grid);
    TEST_EQUALITY(is_coarse.size(), n_local(*nodes->getColMap()));
    bool is_same = true;  // own nodes and ghosts
    for (std::size_t c = 0; c < is_coarse.size(); ++c)
      is_same &=
          is_coarse[c] == expected[nodes->getColMap()->getGlobalElement(static_cast<int>(c))];
    TEST_ASSERT(all_agree(*test::world(), is_same));
  }
}

TEUCHOS_UNIT_TEST(independent_set, is_independent_and_maximal) {
  for (const auto& [nodes, order, hosts, parts, places] : graphs()) {
    const auto is_coarse = algebra::independent_set(*nodes, *order);
    long long n_neighbours_in_the_set = 0, n_without_a_neighbour = 0;
    for (const GlobalOrdinal row : global_numbers(*nodes->getRowMap())) {
      int n_coarse = 0;
      for (const GlobalOrdinal column : columns_of(*nodes, row))
        if (column != row) n_coarse += is_coarse[nodes->getColMap()->getLocalElement(column)];
      if (is_coarse[nodes->getColMap()->getLocalElement(row)])
        n_neighbours_in_the_set += n_coarse;
      else
        n_without_a_neighbour += n_coarse == 0;
    }
    TEST_EQUALITY(global_sum(*nodes->getComm(), n_neighbours_in_the_set), 0);
    TEST_EQUALITY(global_sum(*nodes->getComm(), n_without_a_neighbour), 0);
  }
}

TEUCHOS_UNIT_TEST(independent_set, ghosts_are_in_it_where_their_owner_says_so) {
  for (const auto& [nodes, order, hosts, parts, places] : graphs()) {
    const auto is_coarse = algebra::independent_set(*nodes, *order);
    Vector own(nodes->getRowMap());
    for (const GlobalOrdinal row : global_numbers(*nodes->getRowMap()))
      own.replaceGlobalValue(row, is_coarse[nodes->getColMap()->getLocalElement(row)]);
    const Vector columns = algebra::on_columns(*nodes, own);
    const auto said = columns.getLocalViewHost(read_only);
    bool is_same = true;
    for (std::size_t c = 0; c < is_coarse.size(); ++c) is_same &= said(c, 0) == is_coarse[c];
    TEST_ASSERT(all_agree(*nodes->getComm(), is_same));
  }
}

/// Each node takes the mean of its neighbours in the set that may be its parents; one of the set
/// has itself alone.
template <class MayFollow>
bool takes_means(const CrsGraph& nodes, const CrsMatrix& P, const std::vector<char>& is_coarse,
                 const MayFollow& may_follow) {
  const auto fine_number = fine_numbers(nodes, P, is_coarse);
  bool is_as_defined = true;
  for (const GlobalOrdinal row : global_numbers(*nodes.getRowMap())) {
    std::set<GlobalOrdinal> expected, parents;
    for (const GlobalOrdinal column : columns_of(nodes, row))
      if (is_coarse[nodes.getColMap()->getLocalElement(column)] && may_follow(row, column))
        expected.insert(column);
    for (const auto& [column, weight] : row_of(P, row)) {
      parents.insert(fine_number[column]);
      is_as_defined &= weight == 1.0 / static_cast<double>(expected.size());
    }
    is_as_defined &= parents == expected;
  }
  return all_agree(*nodes.getComm(), is_as_defined);
}

// Ten hubs of six leaves each, which have the lower numbers: by these all leaves would be kept.
TEUCHOS_UNIT_TEST(nodal_coarsening,
                  keeps_far_fewer_nodes_where_those_of_most_neighbours_are_first) {
  constexpr GlobalOrdinal n_hubs = 10, n_leaves = 60;
  const auto map = Teuchos::rcp(new Map(n_hubs + n_leaves, 0, test::world()));
  const auto nodes = Teuchos::rcp(new CrsGraph(map, 7));
  for (const GlobalOrdinal node : global_numbers(*map)) {
    std::vector<GlobalOrdinal> columns(1, node);
    if (node < n_leaves)
      columns.push_back(n_leaves + node / 6);
    else
      for (GlobalOrdinal k = 0; k < 6; ++k) columns.push_back(6 * (node - n_leaves) + k);
    nodes->insertGlobalIndices(node, Teuchos::arrayViewFromVector(columns));
  }
  nodes->fillComplete();
  NodalCoarsening coarsening(nodes, *test::nodes_of(nodes).order);
  TEST_EQUALITY(coarsening.prolongator(0)->getGlobalNumCols(), n_hubs);
  const std::vector<char> kept = kept_nodes(coarsening, *nodes);
  bool are_hubs = true;
  for (const GlobalOrdinal node : global_numbers(*map))
    are_hubs &= (node >= n_leaves) == (kept[nodes->getColMap()->getLocalElement(node)] != 0);
  TEST_ASSERT(all_agree(*test::world(), are_hubs));
}

/// Neighbours and their neighbours, by Tpetra's product.
Teuchos::RCP<const CrsGraph> two_steps(const Teuchos::RCP<const CrsGraph>& nodes) {
  CrsMatrix G(nodes), GG(nodes->getRowMap(), 0);
  G.setAllToScalar(1.0);
  G.fillComplete();
  Tpetra::MatrixMatrix::Multiply(G, false, G, false, GG);
  return GG.getCrsGraph();
}

double part_in_set(const CrsGraph& nodes, const Vector& order) {
  const auto is_coarse = algebra::independent_set(nodes, order);
  long long n = 0;
  for (const GlobalOrdinal row : global_numbers(*nodes.getRowMap()))
    n += is_coarse[nodes.getColMap()->getLocalElement(row)];
  return static_cast<double>(global_sum(*nodes.getComm(), n)) / nodes.getGlobalNumRows();
}

TEUCHOS_UNIT_TEST(nodal_coarsening, each_node_takes_the_mean_of_its_neighbours_in_the_set) {
  for (const auto& [nodes, order, hosts, parts, places] : graphs()) {
    NodalCoarsening coarsening(nodes, *order);
    const auto P = coarsening.prolongator(0);
    const auto near = coarsening.is_wide(0) ? two_steps(nodes) : nodes;
    const std::vector<char> is_coarse = kept_nodes(coarsening, *near);
    TEST_ASSERT(takes_means(*near, *P, is_coarse, [](auto, auto) { return true; }));
  }
}

// By neighbours alone every second node would stay, as on a chessboard.
TEUCHOS_UNIT_TEST(nodal_coarsening, of_grids_with_seven_points_few_nodes_stay) {
  const Grid grid{12, 11, 10, false};
  const auto nodes = grid.graph(test::world());
  const Vector order = *test::nodes_of(nodes).order;
  TEST_COMPARE(part_in_set(*nodes, order), >, 0.45);
  NodalCoarsening coarsening(nodes, order);
  const auto P = coarsening.prolongator(0);
  TEST_ASSERT(coarsening.is_wide(0));
  TEST_COMPARE(static_cast<double>(P->getGlobalNumCols()) / P->getGlobalNumRows(), <, 0.2);
  Vector ones(P->getDomainMap()), image(P->getRangeMap());
  ones.putScalar(1.0);
  P->apply(ones, image);
  Vector one(image.getMap());
  one.putScalar(1.0);
  image.update(-1.0, one, 1.0);
  TEST_COMPARE(image.normInf(), <, 1e-14);
}

TEUCHOS_UNIT_TEST(nodal_coarsening, levels_shrink_and_keep_constants_down_to_one_node) {
  for (const auto& [nodes, order, hosts, parts, places] : graphs()) {
    NodalCoarsening coarsening(nodes, *order);
    TEST_EQUALITY(n_nodes(coarsening, 0), static_cast<long long>(nodes->getGlobalNumRows()));
    int level = 0;
    for (; n_nodes(coarsening, level) > 1 && level < 20; ++level) {
      const auto P = coarsening.prolongator(level);
      TEST_EQUALITY(static_cast<long long>(P->getGlobalNumRows()), n_nodes(coarsening, level));
      TEST_EQUALITY(static_cast<long long>(P->getGlobalNumCols()), n_nodes(coarsening, level + 1));
      TEST_COMPARE(n_nodes(coarsening, level + 1), <, n_nodes(coarsening, level));
      Vector ones(P->getDomainMap()), prolonged(P->getRangeMap());
      ones.putScalar(1.0);
      P->apply(ones, prolonged);  // the row sums
      ones = Vector(P->getRangeMap());
      ones.putScalar(1.0);
      prolonged.update(-1.0, ones, 1.0);
      TEST_COMPARE(prolonged.normInf(), <, 1e-14);
    }
    TEST_EQUALITY(n_nodes(coarsening, level), 1);
  }
}

TEUCHOS_UNIT_TEST(nodal_coarsening, prolongators_of_grids_do_not_depend_on_the_ranks) {
  for (const Grid& grid : grids) {
    const auto nodes = grid.graph(test::world()), alone = grid.graph(test::alone());
    NodalCoarsening parallel(nodes, *test::nodes_of(nodes).order);
    NodalCoarsening serial(alone, *test::nodes_of(alone).order);
    for (int level = 0; n_nodes(serial, level) > 1; ++level) {
      const auto P = parallel.prolongator(level), expected = serial.prolongator(level);
      TEST_EQUALITY(n_nodes(parallel, level + 1), n_nodes(serial, level + 1));
      bool is_same = true;
      for (const GlobalOrdinal row : global_numbers(*P->getRowMap()))
        is_same &= row_of(*P, row) == row_of(*expected, row);
      TEST_ASSERT(all_agree(*test::world(), is_same));
    }
  }
}

TEUCHOS_UNIT_TEST(nodal_coarsening, levels_of_a_mesh_do_not_depend_on_how_it_is_partitioned) {
  const auto parallel = graphs(), serial = graphs(test::alone());
  for (std::size_t g = 0; g < parallel.size(); ++g) {
    NodalCoarsening all(parallel[g].graph, *parallel[g].order);
    NodalCoarsening one(serial[g].graph, *serial[g].order);
    for (int level = 0; n_nodes(one, level) > 1; ++level)
      TEST_EQUALITY(n_nodes(all, level + 1), n_nodes(one, level + 1));
  }
}

TEUCHOS_UNIT_TEST(nodal_coarsening,
                  nodes_between_fields_are_first_and_have_parents_among_themselves) {
  const Grid grid{9, 7, 5, true};
  const auto is_between = [&](GlobalOrdinal node) { return node / (grid.nx * grid.ny) == 3; };
  const auto nodes = grid.graph(test::world());
  const auto between = Teuchos::rcp(new Vector(nodes->getRowMap()));
  for (const GlobalOrdinal node : global_numbers(*nodes->getRowMap()))
    between->replaceGlobalValue(node, is_between(node) ? 1.0 : 0.0);
  const auto P = NodalCoarsening(nodes, *test::nodes_of(nodes).order, between).prolongator(0);
  const std::vector<char> is_coarse = greedy_set(grid, is_between);
  std::vector<char> on_columns;
  for (const GlobalOrdinal node : global_numbers(*nodes->getColMap()))
    on_columns.push_back(is_coarse[node]);
  TEST_ASSERT(takes_means(*nodes, *P, on_columns, [&](GlobalOrdinal node, GlobalOrdinal parent) {
    return is_between(parent) || !is_between(node);
  }));
}

TEUCHOS_UNIT_TEST(nodal_coarsening, a_quarter_of_quadratic_elements_stays_in_a_plane) {
  const auto part_of = [](const Teuchos::RCP<const CrsGraph>& nodes, bool is_plane) {
    NodalCoarsening all(nodes, *test::nodes_of(nodes).order, Teuchos::null, {}, nullptr, is_plane);
    return static_cast<double>(n_nodes(all, 1)) / static_cast<double>(n_nodes(all, 0));
  };
  const auto quadratic = test::quadratic_plane(test::world(), 16);
  TEST_FLOATING_EQUALITY(part_of(quadratic, true), 0.25, 0.1);
  TEST_COMPARE(part_of(quadratic, false), <, 0.22);
  const auto linear = Grid{33, 33, 1, true}.graph(test::world());  // where another order is as even
  TEST_EQUALITY(part_of(linear, true), part_of(linear, false));
}

TEUCHOS_UNIT_TEST(nodal_coarsening, what_was_made_once_is_kept) {
  const auto nodes = grids[0].graph(test::world());
  NodalCoarsening coarsening(nodes, *test::nodes_of(nodes).order);
  for (const int level : {1, 0}) {
    const auto first = coarsening.prolongator(level);
    TEST_EQUALITY(coarsening.prolongator(level).get(), first.get());
  }
}

/// Two layers of a wall, whose pressures jump between them.
struct SplitWall {
  explicit SplitWall(const CommPtr& comm = test::world())
      : tube(comm), split(fields::split_mesh(tube.wall, {0, 0, 1})),
        K(tube.wall, fields::mixed_blocks, split.get()),
        leader(std::make_shared<NodalCoarsening>(nodes(0).graph, *nodes(0).order)),
        follower(nodes(1).graph, *nodes(1).order, *nodes(1).hosts, leader) {}

  const algebra::Nodes& nodes(int block) const { return (*K.space())[block].nodes; }

  SmallTube tube;
  std::unique_ptr<fields::SplitMesh> split;
  fields::BlockOperator K;
  std::shared_ptr<NodalCoarsening> leader;
  NodalCoarsening follower;
};

TEUCHOS_UNIT_TEST(nodal_coarsening, followers_stay_where_their_hosts_stay) {
  SplitWall wall;
  for (int level = 0; level < 2; ++level) {
    const auto P = wall.follower.prolongator(level), host_P = wall.leader->prolongator(level);
    const auto hosts = wall.follower.hosts(level)->getLocalViewHost(read_only);
    const auto is_single = [](const std::map<GlobalOrdinal, Scalar>& row) {
      return row.size() == 1 && row.begin()->second == 1.0;
    };
    std::set<GlobalOrdinal> coarse_hosts;
    for (const int row : wall.leader->coarse_rows(level))
      coarse_hosts.insert(host_P->getRowMap()->getGlobalElement(row));
    std::set<int> coarse(wall.follower.coarse_rows(level).begin(),
                         wall.follower.coarse_rows(level).end());
    bool follows = true, keeps_numbers = true;
    for (int i = 0; i < static_cast<int>(n_local_rows(*P)); ++i) {
      const auto host = static_cast<GlobalOrdinal>(hosts(i, 0));
      if (coarse_hosts.count(host) == 0) continue;
      const GlobalOrdinal number = P->getRowMap()->getGlobalElement(i);
      follows &= coarse.count(i) == 1 && is_single(row_of(*P, number));
      if (number == host) keeps_numbers &= row_of(*P, number) == row_of(*host_P, host);
    }
    TEST_ASSERT(all_agree(*test::world(), follows));
    TEST_ASSERT(all_agree(*test::world(), keeps_numbers));
    for (const GlobalOrdinal row : global_numbers(*P->getRowMap()))
      TEST_ASSERT(!row_of(*P, row).empty());
  }
}

TEUCHOS_UNIT_TEST(nodal_coarsening, followers_in_different_parts_do_not_mix) {
  SplitWall wall;
  std::vector<double> part(wall.split->n_owned);
  for (std::size_t e = 0; e < wall.split->tets.size(); ++e)
    for (const int a : wall.split->tets[e])
      if (a < wall.split->n_owned) part[a] = wall.split->region[e] == 2 ? 1.0 : 0.0;
  Vector fine(wall.split->node_map);
  for (int a = 0; a < wall.split->n_owned; ++a) fine.replaceLocalValue(a, part[a]);
  for (int level = 0; level < 2; ++level) {
    const auto P = wall.follower.prolongator(level);
    Vector coarse(P->getDomainMap()), back(P->getRangeMap());
    const std::vector<int>& rows = wall.follower.coarse_rows(level);
    for (std::size_t c = 0; c < rows.size(); ++c)
      coarse.replaceLocalValue(static_cast<int>(c), fine.getData()[rows[c]]);
    P->apply(coarse, back);  // the part of a node is that of all it takes its mean from
    back.update(-1.0, fine, 1.0);
    TEST_COMPARE(back.normInf(), <, 1e-14);
    fine = Vector(coarse, Teuchos::Copy);
  }
}

TEUCHOS_UNIT_TEST(nodal_coarsening, followers_are_as_many_on_any_ranks) {
  SplitWall many, one(test::alone());
  for (int level = 0; level < 3; ++level)
    TEST_EQUALITY(n_nodes(many.follower, level), n_nodes(one.follower, level));
}

TEUCHOS_UNIT_TEST(nodal_coarsening, followers_on_the_same_nodes_are_their_hosts) {
  const auto nodes = grids.front().graph(test::world());
  const algebra::Nodes own = test::nodes_of(nodes);
  const auto leader = std::make_shared<NodalCoarsening>(nodes, *own.order);
  NodalCoarsening follower(nodes, *own.order, *own.order, leader);  // numbers are the order
  for (int level = 0; level < 2; ++level) {
    const auto P = follower.prolongator(level), expected = leader->prolongator(level);
    bool is_same = P->getDomainMap()->isSameAs(*expected->getDomainMap());
    for (const GlobalOrdinal row : global_numbers(*P->getRowMap()))
      is_same &= row_of(*P, row) == row_of(*expected, row);
    TEST_ASSERT(all_agree(*test::world(), is_same));
  }
}

}  // namespace
