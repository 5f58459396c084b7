#include <Teuchos_UnitTestHarness.hpp>
#include <Tpetra_Core.hpp>

#include "tunica/base/trilinos.hpp"
#include "tunica/foreign/default_settings.hpp"
#include "tunica/foreign/factor_cost.hpp"
#include "tunica/foreign/rigid_fit.hpp"

namespace {

using namespace tunica;

Teuchos::RCP<CrsMatrix> diagonal_matrix(const Teuchos::RCP<const Map>& map, double value) {
  const auto A = Teuchos::rcp(new CrsMatrix(map, 1));
  for (const GlobalOrdinal row : global_numbers(*map)) A->insertGlobalValues(row, 1, &value, &row);
  A->fillComplete();
  return A;
}

/// As far as both reach.
Teuchos::RCP<CrsMatrix> diagonal_matrix(const Teuchos::RCP<const Map>& rows,
                                        const Teuchos::RCP<const Map>& columns, double value) {
  const auto A = Teuchos::rcp(new CrsMatrix(rows, 1));
  for (const GlobalOrdinal row : global_numbers(*rows))
    if (row <= columns->getMaxAllGlobalIndex()) A->insertGlobalValues(row, 1, &value, &row);
  A->fillComplete(columns, rows);
  return A;
}

/// A of pairs.
Teuchos::RCP<CrsMatrix> coupled_matrix(const Teuchos::RCP<const Map>& map) {
  const auto A = Teuchos::rcp(new CrsMatrix(map, 2));
  for (const GlobalOrdinal row : global_numbers(*map)) {
    const GlobalOrdinal both[] = {row, row % 2 == 0 ? row + 1 : row - 1};
    const double values[] = {2.0, -1.0};
    A->insertGlobalValues(row, 2, values, both);
  }
  A->fillComplete();
  return A;
}

/// Of a cube of nodes with so many along each edge, each coupled with its 26 neighbours.
Teuchos::RCP<const CrsGraph> cube_graph(int along) {
  const Teuchos::RCP<const Map> map =
      Teuchos::rcp(new Map(along * along * along, 0, Tpetra::getDefaultComm()));
  const auto graph = Teuchos::rcp(new CrsGraph(map, 27));
  for (const GlobalOrdinal row : global_numbers(*map)) {
    std::vector<GlobalOrdinal> columns;
    for (GlobalOrdinal column = 0; column < along * along * along; ++column) {
      bool is_near = true;
      for (GlobalOrdinal i = row, j = column, k = 0; k < 3; ++k, i /= along, j /= along)
        is_near = is_near && std::abs(i % along - j % along) <= 1;
      if (is_near) columns.push_back(column);
    }
    graph->insertGlobalIndices(row, columns);
  }
  graph->fillComplete();
  return graph;
}

/// Blocks of diagonals, but for A; c: of C. With share vectors for each scalar.
algebra::BlockMatrix blocks(bool has_scalars, double c, bool is_coupled = true, int share = 1,
                            int components = 1) {
  const CommPtr comm = Tpetra::getDefaultComm();
  const auto vectors = Teuchos::rcp(new Map(8 * share, 0, comm)),
             scalars = Teuchos::rcp(new Map(8, 0, comm));
  std::vector<algebra::Block> of_space{{"vector", vectors, components, {}}};
  if (has_scalars) of_space.push_back({"scalar", scalars, 1, {}});
  algebra::BlockMatrix K(std::make_shared<const algebra::BlockSpace>(of_space));
  K.set(0, 0, is_coupled ? coupled_matrix(vectors) : diagonal_matrix(vectors, 2.0));
  if (!has_scalars) return K;
  K.set(0, 1, diagonal_matrix(vectors, scalars, 1.0));
  K.set(1, 0, diagonal_matrix(scalars, vectors, 1.0));
  K.set(1, 1, diagonal_matrix(scalars, -c));
  return K;
}

std::vector<std::string> names(const foreign::DefaultChoice& choice) {
  std::vector<std::string> all;
  for (const auto& setting : choice.settings) all.push_back(setting.name);
  return all;
}

class KnownSchur : public linear::NamedOperators {
public:
  std::vector<std::string> operator_names() const override { return {"Given Schur"}; }
  Teuchos::RCP<const CrsMatrix> assemble_operator(const std::string&) const override {
    return Teuchos::null;
  }
};

using Names = std::vector<std::string>;

TEUCHOS_UNIT_TEST(default_settings, follow_what_the_matrix_is) {
  const auto stabilised = foreign::default_settings(blocks(true, 1.0), 0.0);
  TEST_ASSERT(names(stabilised) ==
              (Names{"multigrid, incomplete factors", "multigrid, Braess-Sarazin", "field by field",
                     "ILU(1)", "direct at any cost"}));
  TEST_EQUALITY(stabilised.reason, "C stabilises");
  const auto zero = foreign::default_settings(blocks(true, 0.0, true, 1, 2), 0.0);
  TEST_ASSERT(names(zero) ==
              (Names{"multigrid, Braess-Sarazin", "field by field", "direct at any cost"}));
  TEST_EQUALITY(foreign::in_words(zero), "\"multigrid, Braess-Sarazin\" (C is zero)");
  const auto given = foreign::default_settings(blocks(true, 0.0), 0.0, KnownSchur());
  TEST_EQUALITY(names(given).front(), "field by field, S given");
  const auto few = foreign::default_settings(blocks(true, 1.0, true, 3), 0.0);
  TEST_EQUALITY(names(few).front(), "multigrid, Braess-Sarazin");
  TEST_EQUALITY(few.reason, "few scalars");
  const auto diagonal = foreign::default_settings(blocks(true, 0.0, false), 0.0);
  TEST_EQUALITY(names(diagonal).front(), "field by field");
  TEST_EQUALITY(diagonal.reason, "A is diagonal");
  // Pairs [2 -1; -1 2] are near their diagonal, which counts for fluxes, of one component.
  const auto fluxes = foreign::default_settings(blocks(true, 0.0), 0.0);
  TEST_EQUALITY(names(fluxes).front(), "field by field");
  TEST_EQUALITY(fluxes.reason, "A is near its diagonal");
  TEST_ASSERT(names(foreign::default_settings(blocks(false, 0.0), 0.0)) ==
              (Names{"multigrid, Gauss-Seidel", "ILU(1)", "direct at any cost"}));
}

/// Pairs of vectors and a scalar at each node, without C; B2 couples the scalar with the first of
/// its own pair, and, with this value, with that of the next node.
algebra::BlockMatrix control(double beyond) {
  algebra::BlockMatrix K = blocks(true, 0.0, true, 2, 2);
  const auto B2 = Teuchos::rcp(new CrsMatrix(K(1, 1)->getRowMap(), 2));
  for (const GlobalOrdinal node : global_numbers(*K(1, 1)->getRowMap())) {
    const GlobalOrdinal columns[] = {2 * node, 2 * ((node + 1) % 8)};
    const double values[] = {1.0, beyond};
    B2->insertGlobalValues(node, 2, values, columns);
  }
  B2->fillComplete(K(0, 0)->getRowMap(), K(1, 1)->getRowMap());
  K.set(1, 0, B2);
  return K;
}

// Of b_i = B2_ii²/A_ii + B2_ij²/A_jj the own node has 1/(1 + beyond²).
TEUCHOS_UNIT_TEST(default_settings, incomplete_factors_serve_without_c_where_nodes_have_pivots) {
  const auto own = foreign::default_settings(control(1.0), 1500.0);
  TEST_EQUALITY(own.reason, "C is zero, but each node has a pivot");
  TEST_EQUALITY(own.settings[1].name, "multigrid, incomplete factors");
  TEST_EQUALITY(own.settings.front().list.get<double>("most operations"), 500.0);
  TEST_EQUALITY(foreign::default_settings(control(2.0), 1500.0).reason, "C is zero");
}

/// A of two components by themselves, in which the first unknown has this diagonal.
Teuchos::RCP<CrsMatrix> plain_matrix(const Teuchos::RCP<const Map>& map, double first) {
  const auto A = Teuchos::rcp(new CrsMatrix(map, 3));
  const auto n = static_cast<GlobalOrdinal>(map->getGlobalNumElements());
  for (const GlobalOrdinal row : global_numbers(*map))
    for (const GlobalOrdinal column : {row - 2, row, row + 2}) {
      const double value = column != row ? -1.0 : row == 0 ? first : 2.0;
      if (column >= 0 && column < n) A->insertGlobalValues(row, 1, &value, &column);
    }
  A->fillComplete();
  return A;
}

TEUCHOS_UNIT_TEST(default_settings, fewer_factors_come_before_sweeps_where_a_is_plain) {
  algebra::BlockMatrix K = control(2.0);
  const auto most = [&] {
    const auto choice = foreign::default_settings(K, 1500.0);
    TEST_EQUALITY(choice.reason, "C is zero");
    return choice.settings.front().list.get<double>("most operations");
  };
  K.set(0, 0, plain_matrix(K(0, 0)->getRowMap(), 2.0));
  TEST_EQUALITY(most(), 750.0);
  K.set(0, 0, plain_matrix(K(0, 0)->getRowMap(), 2001.0));
  TEST_EQUALITY(most(), 1500.0);
}

// Entries of a mass are positive, those of derivatives add up to nothing.
TEUCHOS_UNIT_TEST(default_settings, fields_come_first_where_a_mass_outweighs_the_rest) {
  algebra::BlockMatrix K = blocks(true, 1.0);
  TEST_EQUALITY(foreign::default_settings(K, 0.0).reason, "C stabilises");
  const Map& rows = *K(0, 0)->getRowMap();
  const auto mass = Teuchos::rcp(new CrsMatrix(K(0, 0)->getRowMap(), 8));
  for (const GlobalOrdinal row : global_numbers(rows))
    for (GlobalOrdinal column = 0; column < 8; ++column)
      mass->insertGlobalValues(row, Teuchos::tuple(column),
                               Teuchos::tuple(column == row ? 1.0 : 0.5));
  mass->fillComplete();
  K.set(0, 0, mass);
  const auto choice = foreign::default_settings(K, 0.0);
  TEST_EQUALITY(choice.reason, "A is near its diagonal");
  TEST_EQUALITY(names(choice).front(), "field by field");
  TEST_EQUALITY(names(choice)[1], "multigrid, incomplete factors");
}

TEUCHOS_UNIT_TEST(default_settings, factors_come_first_while_they_are_few_for_the_matrix) {
  const auto choice = foreign::default_settings(blocks(true, 0.0, true, 1, 2), 1500.0);
  TEST_ASSERT(
      names(choice) ==
      (Names{"direct", "multigrid, Braess-Sarazin", "direct where that is slow",
             "multigrid, Braess-Sarazin to the end", "field by field", "direct at any cost"}));
  // What is slow is given up where the factors that come next take less, and not the second time.
  TEST_EQUALITY(choice.settings[1].list.get<int>("give up at"), 100);
  TEST_EQUALITY(choice.settings[2].list.get<double>("most operations"), 20000.0);
  TEST_EQUALITY(choice.settings[3].list.get<int>("give up at"), 0);
  TEST_ASSERT(
      names(foreign::default_settings(blocks(true, 0.0, true, 3, 3), 1500.0)) ==
      (Names{"direct", "multigrid, Braess-Sarazin", "field by field", "direct at any cost"}));
  TEST_EQUALITY(choice.settings.front().list.get<double>("most operations"), 1500.0);
  const auto stabilised = foreign::default_settings(blocks(true, 1.0), 1500.0);
  TEST_EQUALITY(stabilised.settings.front().list.get<double>("most operations"), 1500.0);
  TEST_EQUALITY(choice.settings.back().list.get<double>("most operations"), 0.0);
  TEST_EQUALITY(
      foreign::in_words(choice),
      "\"direct\" unless its factors are large, then \"multigrid, Braess-Sarazin\" (C is zero)");
}

// Of the graph alone: the blocks here have next to no entries, so that a count per entry is large.
TEUCHOS_UNIT_TEST(default_settings, leave_factors_out_that_are_large_by_the_graph_of_nodes) {
  for (const int along : {2, 8}) {
    const int n = along * along * along;
    const CommPtr comm = Tpetra::getDefaultComm();
    const auto vectors = Teuchos::rcp(new Map(3 * n, 0, comm)),
               scalars = Teuchos::rcp(new Map(n, 0, comm));
    algebra::Nodes nodes;
    nodes.graph = cube_graph(along);
    algebra::BlockMatrix K(std::make_shared<const algebra::BlockSpace>(
        std::vector<algebra::Block>{{"vector", vectors, 3, nodes}, {"scalar", scalars, 1, nodes}}));
    K.set(0, 0, coupled_matrix(vectors));
    K.set(0, 1, diagonal_matrix(vectors, scalars, 1.0));
    K.set(1, 0, diagonal_matrix(scalars, vectors, 1.0));
    K.set(1, 1, diagonal_matrix(scalars, -1.0));
    const auto choice = foreign::default_settings(K, 3000.0);
    // Dense factors of 32 unknowns take 2/3 32³ = 22,000 operations, of 9 entries per node 300
    // each.
    const bool is_small = along == 2;
    TEST_EQUALITY(names(choice).front(), is_small ? "direct" : "multigrid, incomplete factors");
    TEST_EQUALITY(choice.operations == 0.0, is_small);
    const std::string words = foreign::in_words(choice);
    TEST_EQUALITY(words.find("sparse LU would take some") == std::string::npos, is_small);
  }
}

// Springs between neighbours, of which those of a node inside balance when it turns.
TEUCHOS_UNIT_TEST(default_settings, leave_places_aside_that_are_not_those_of_the_matrix) {
  const int along = 7, n = along * along * along;
  for (const int stride : {1, 5}) {  // 5 has no factor in common with 7³
    algebra::Nodes nodes;
    nodes.graph = cube_graph(along);
    const Map& own = *nodes.graph->getRowMap();
    const auto unknowns = Teuchos::rcp(new Map(3 * n, 3 * n_local(own), 0, own.getComm()));
    const auto A = Teuchos::rcp(new CrsMatrix(unknowns, 27));
    const auto x = Teuchos::rcp(new MultiVector(nodes.graph->getRowMap(), 3));
    const auto in_solid = Teuchos::rcp(new Vector(nodes.graph->getRowMap()));
    in_solid->putScalar(1.0);
    const auto graph = nodes.graph->getLocalGraphHost();
    for (int a = 0; a < static_cast<int>(n_local(own)); ++a) {
      const GlobalOrdinal node = own.getGlobalElement(a);
      const auto row = graph.rowConst(a);
      for (int k = 0; k < row.length; ++k)
        for (int i = 0; i < 3; ++i) {
          const GlobalOrdinal other = nodes.graph->getColMap()->getGlobalElement(row(k));
          A->insertGlobalValues(3 * node + i, Teuchos::tuple<GlobalOrdinal>(3 * other + i),
                                Teuchos::tuple(other == node ? row.length - 1.0 : -1.0));
        }
      GlobalOrdinal place = node * stride % n;
      for (int i = 0; i < 3; ++i, place /= along)
        x->replaceLocalValue(a, i, static_cast<double>(place % along));
    }
    A->fillComplete();
    nodes.places = {x, in_solid};
    algebra::BlockMatrix K(std::make_shared<const algebra::BlockSpace>(
        std::vector<algebra::Block>{{"vector", unknowns, 3, nodes}}));
    K.set(0, 0, A);
    const bool is_right = stride == 1;
    const double inside = std::pow((along - 2.0) / along, 3) - 1e-12;
    const foreign::RigidFit fit = foreign::rigid_fit(K);
    TEST_EQUALITY(fit.resting >= inside, is_right);
    TEST_EQUALITY(fit.resting < 0.1, !is_right);
    TEST_EQUALITY(fit.centred >= inside, is_right);
    const auto choice = foreign::default_settings(K, 0.0);
    TEST_EQUALITY(choice.are_places_wrong, !is_right);
    Teuchos::ParameterList list = choice.settings.front().list;
    const Teuchos::ParameterList& levels = list.sublist("MueLu").sublist("Factories");
    TEST_EQUALITY(levels.sublist("Nodes").get<bool>("rotations"), is_right);
    TEST_EQUALITY(levels.sublist("Nodes").get<double>("rotations from"), is_right ? 0.0 : 0.25);
    TEST_EQUALITY(foreign::in_words(choice).find("left aside") == std::string::npos, is_right);
  }
}

// n vectors that nothing couples but n scalars, each with all of them: once one side is gone, the
// other one is dense.
TEUCHOS_UNIT_TEST(factor_cost, counts_what_scalars_on_nodes_of_their_own_couple) {
  const int n = 24;
  const CommPtr comm = Tpetra::getDefaultComm();
  const auto rows = Teuchos::rcp(new Map(n, 0, comm));
  algebra::Nodes nodes, own;
  nodes.graph = diagonal_matrix(rows, 1.0)->getCrsGraph();
  own.graph = diagonal_matrix(rows, 1.0)->getCrsGraph();
  const auto B = Teuchos::rcp(new CrsMatrix(rows, n));
  for (const GlobalOrdinal row : global_numbers(*rows))
    for (GlobalOrdinal column = 0; column < n; ++column)
      B->insertGlobalValues(row, Teuchos::tuple(column), Teuchos::tuple(1.0));
  B->fillComplete();
  algebra::BlockMatrix K(std::make_shared<const algebra::BlockSpace>(
      std::vector<algebra::Block>{{"vector", rows, 1, nodes}, {"scalar", rows, 1, own}}));
  K.set(0, 0, diagonal_matrix(rows, 1.0));
  K.set(0, 1, B);
  K.set(1, 0, B);
  K.set(1, 1, diagonal_matrix(rows, 0.0));
  // 4/3 n³ operations and more, as many as 2/3 (2n)³ in one front of all, for 2 n² + 2 n entries
  const double all = foreign::operations_by_all_nodes(K, 1e9);
  TEST_COMPARE(all, >, 0.6 * n);
  TEST_COMPARE(all, <, 8.0 / 3.0 * n);
  TEST_COMPARE(foreign::operations_by_vectors(K, 1e9), <, 1.0);
  // An estimate by the vectors is believed, but for one that is near what may be.
  const double most = 0.5 * n;
  TEST_ASSERT(foreign::is_factoring_dear(K, 2.1 * most, most));
  TEST_ASSERT(foreign::is_factoring_dear(K, 0.6 * most, most));
  TEST_ASSERT(!foreign::is_factoring_dear(K, 0.4 * most, most));
  TEST_ASSERT(!foreign::is_factoring_dear(K, 0.6 * 8.0 / 3.0 * n, 8.0 / 3.0 * n));
  algebra::BlockMatrix shared(std::make_shared<const algebra::BlockSpace>(
      std::vector<algebra::Block>{{"vector", rows, 1, nodes}, {"scalar", rows, 1, nodes}}));
  TEST_ASSERT(!foreign::is_factoring_dear(shared, 0.6 * most, most));
}

}  // namespace
