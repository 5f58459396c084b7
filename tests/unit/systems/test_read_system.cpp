#include <Teuchos_UnitTestHarness.hpp>
#include <functional>
#include <list>
#include <map>
#include <numeric>
#include <set>
#include <sstream>

#include "helpers.hpp"
#include "tunica/base/error.hpp"
#include "tunica/base/trilinos.hpp"
#include "tunica/systems/read_system.hpp"

namespace {

using namespace tunica;
using namespace tunica::systems_tests;
using systems::read_system;
using systems::System;

constexpr int n_nodes = 9, n_vector = 2 * n_nodes;  // a chain, two components

// The blocks in the order by node; scalar k stands on node of_scalar(k).
double a(int i, int j) {
  return std::abs(i / 2 - j / 2) > 1 ? 0.0 : (i == j ? 9.0 : 0.0) + 1.0 / (1 + i + 2 * j);
}
double b1t(int i, int k) { return std::abs(i / 2 - k) > 1 ? 0.0 : 0.3 * i - 0.7 * k + 0.1; }
double b2(int k, int j) { return b1t(j, k); }
double c(int k, int l) { return std::abs(k - l) > 1 ? 0.0 : 0.5 + k + l; }

/// Which unknown stands at each place of a file.
using Order = std::vector<int>;

Order natural(int n) {
  Order order(n);
  std::iota(order.begin(), order.end(), 0);
  return order;
}
Order mixed(int n) {
  Order order;
  for (int k = 0; k < n; ++k) order.push_back((5 * k + 3) % n);
  return order;
}

std::string text_of(const std::function<double(int, int)>& value, const Order& rows,
                    const Order& columns) {
  std::ostringstream entries;
  entries.precision(17);
  int n = 0;
  for (std::size_t i = 0; i < rows.size(); ++i)
    for (std::size_t j = 0; j < columns.size(); ++j)
      if (const double entry = value(rows[i], columns[j]); entry != 0.0) {
        entries << i + 1 << ' ' << j + 1 << ' ' << entry << '\n';
        ++n;
      }
  return "%%MatrixMarket matrix coordinate real general\n" + std::to_string(rows.size()) + " " +
         std::to_string(columns.size()) + " " + std::to_string(n) + "\n" + entries.str();
}

/// The files of a system, and the options that name them.
class Files {
public:
  explicit Files(const Order& vectors = natural(n_vector),
                 const Order& scalars = natural(n_nodes)) {
    options.set("components", 2).set<std::string>("order", "by node").set("C factor", 1.0);
    for (const char* optional : {"K", "B1T", "C", "node map", "coordinates", "schur", "exclude"})
      options.set<std::string>(optional, "");
    // As it stands in the files; test_preparation.cpp has what is made of it.
    options.set("negligible", 0.0)
        .set("known values", false)
        .set("null space", false)
        .set("border", false);
    options.set<std::string>("scaling", "none");
    set("A", text_of(a, vectors, vectors));
    set("B2", text_of(b2, scalars, vectors));
    const std::size_t n = vectors.size() + scalars.size();
    std::string rhs = "%%MatrixMarket matrix array real general\n" + std::to_string(n) + " 1\n";
    for (const int i : vectors) rhs += std::to_string(i) + "\n";
    for (const int k : scalars) rhs += std::to_string(100 + k) + "\n";
    set("rhs", rhs);
  }
  void set(const std::string& key, const std::string& text) {
    files_.emplace_back(text);
    options.set(key, files_.back().path);
  }
  Teuchos::ParameterList options;

private:
  std::list<File> files_;
};

/// The entries in each row of the rank, by numbers.
using Row = std::map<GlobalOrdinal, double>;
std::map<GlobalOrdinal, Row> rows_of(const CrsMatrix& A) {
  std::map<GlobalOrdinal, Row> rows;
  for (const GlobalOrdinal row : global_numbers(*A.getRowMap())) {
    CrsMatrix::local_inds_host_view_type columns;
    CrsMatrix::values_host_view_type values;
    A.getLocalRowView(A.getRowMap()->getLocalElement(row), columns, values);
    for (std::size_t k = 0; k < columns.extent(0); ++k)
      rows[row][A.getColMap()->getGlobalElement(columns(k))] = values(k);
  }
  return rows;
}
std::map<GlobalOrdinal, std::set<GlobalOrdinal>> rows_of(const CrsGraph& graph) {
  std::map<GlobalOrdinal, std::set<GlobalOrdinal>> rows;
  for (const GlobalOrdinal row : global_numbers(*graph.getRowMap())) {
    CrsGraph::local_inds_host_view_type columns;
    graph.getLocalRowView(graph.getRowMap()->getLocalElement(row), columns);
    for (std::size_t k = 0; k < columns.extent(0); ++k)
      rows[row].insert(graph.getColMap()->getGlobalElement(columns(k)));
  }
  return rows;
}
Row values_of(const Vector& x) {
  Row values;
  const auto view = x.getLocalViewHost(read_only);
  for (std::size_t i = 0; i < view.extent(0); ++i)
    values[x.getMap()->getGlobalElement(static_cast<LocalOrdinal>(i))] = view(i, 0);
  return values;
}

template <class Rows>
bool is_part(const Rows& mine, const Rows& whole) {
  for (const auto& [row, entries] : mine)
    if (whole.count(row) == 0 || whole.at(row) != entries) return false;
  return true;
}

/// Whether the ranks have parts of the system that each has alone.
bool is_dealt(const System& mine, const System& whole) {
  bool is_same = true;
  for (int i : {0, 1}) {
    for (int j : {0, 1})
      is_same = is_same && is_part(rows_of(*mine.K(i, j)), rows_of(*whole.K(i, j)));
    const auto &nodes = (*mine.K.space())[i].nodes, &all = (*whole.K.space())[i].nodes;
    is_same = is_same && is_part(rows_of(*nodes.graph), rows_of(*all.graph)) &&
              is_part(values_of(*nodes.order), values_of(*all.order)) &&
              is_part(values_of(mine.b[i]), values_of(whole.b[i])) &&
              mine.b[i].getGlobalLength() == whole.b[i].getGlobalLength() &&
              nodes.graph->getGlobalNumRows() == all.graph->getGlobalNumRows();
  }
  return is_same && mine.K.n_unknowns() == whole.K.n_unknowns();
}
bool is_dealt(const Files& files, const Files& same) {
  return is_dealt(read_system(files.options, world(), at_once), read_system(same.options, alone()));
}
bool is_dealt(const Files& files) { return is_dealt(files, files); }

TEUCHOS_UNIT_TEST(read_system, blocks_are_those_of_the_files) {
  Files files;
  files.set("C", text_of(c, natural(n_nodes), natural(n_nodes)));
  files.options.set("C factor", 2.0);
  const System system = read_system(files.options, world(), at_once);
  for (const auto& [i, row] : rows_of(*system.K(0, 0)))
    for (const auto& [j, value] : row) TEST_EQUALITY(value, a(int(i), int(j)));
  for (const auto& [i, row] : rows_of(*system.K(0, 1)))
    for (const auto& [k, value] : row) TEST_EQUALITY(value, b1t(int(i), int(k)));
  for (const auto& [k, row] : rows_of(*system.K(1, 1)))
    for (const auto& [l, value] : row) TEST_EQUALITY(value, -2.0 * c(int(k), int(l)));
  TEST_ASSERT(is_dealt(files));
}

TEUCHOS_UNIT_TEST(read_system, without_a_file_B1T_is_the_transpose_of_B2) {
  Files files;
  files.set("B1T", text_of(b1t, natural(n_vector), natural(n_nodes)));
  TEST_ASSERT(is_dealt(Files(), files));
}

TEUCHOS_UNIT_TEST(read_system, an_absent_C_has_a_diagonal_of_zeros) {
  const System system = read_system(Files().options, world(), at_once);
  for (const auto& [k, row] : rows_of(*system.K(1, 1))) TEST_ASSERT(row == (Row{{k, 0.0}}));
}

TEUCHOS_UNIT_TEST(read_system, a_symmetric_file_is_as_good_as_a_general_one) {
  const auto symmetric = [](int i, int j) { return a(std::max(i, j), std::min(i, j)); };
  const auto lower = [](int i, int j) { return i < j ? 0.0 : a(i, j); };
  const std::string layout = "real general";
  std::string half = text_of(lower, natural(n_vector), natural(n_vector));
  half.replace(half.find(layout), layout.size(), "real symmetric");
  Files files, same;
  files.set("A", half);
  same.set("A", text_of(symmetric, natural(n_vector), natural(n_vector)));
  TEST_ASSERT(is_dealt(files, same));
}

/// The entry of a row, where this rank has it; what is given elsewhere.
double entry(const CrsMatrix& A, GlobalOrdinal row, GlobalOrdinal column, double elsewhere) {
  const auto rows = rows_of(A);
  return rows.count(row) > 0 ? rows.at(row).at(column) : elsewhere;
}

TEUCHOS_UNIT_TEST(read_system, unknowns_without_an_equation_are_zero_where_that_is_possible) {
  Files files;
  const auto but_for_two = [](int k, int j) { return k == 2 || k == 5 ? 0.0 : b2(k, j); };
  files.set("B2", text_of(but_for_two, natural(n_nodes), natural(n_vector)));
  files.set("B1T", text_of(b1t, natural(n_vector), natural(n_nodes)));
  std::string rhs =
      "%%MatrixMarket matrix array real general\n" + std::to_string(n_vector + n_nodes) + " 1\n";
  for (int i = 0; i < n_vector + n_nodes; ++i) rhs += "0\n";
  TEST_THROW(read_system(files.options, world(), at_once), Error);  // x = 102 has no equation
  files.set("rhs", rhs);
  const System system = read_system(files.options, world(), at_once);
  for (const int k : {2, 5}) TEST_EQUALITY(entry(*system.K(1, 1), k, k, -1.0), -1.0);
  TEST_EQUALITY(entry(*system.K(1, 1), 3, 3, 0.0), 0.0);
  if (world()->getRank() == 0)
    TEST_ASSERT(system.remarks.size() == 1 &&
                system.remarks[0].find("rows 3 and 6 of B2 and C have no entries") == 0);
}

TEUCHOS_UNIT_TEST(read_system, a_C_as_it_stands_in_K_is_doubted) {
  Files files;
  const auto minus_c = [](int k, int l) { return -c(k, l); };
  files.set("C", text_of(c, natural(n_nodes), natural(n_nodes)));
  TEST_ASSERT(read_system(files.options, world(), at_once).remarks.empty());
  files.set("C", text_of(minus_c, natural(n_nodes), natural(n_nodes)));
  const System system = read_system(files.options, world(), at_once);
  if (world()->getRank() == 0)
    TEST_ASSERT(system.remarks.size() == 1 &&
                system.remarks[0].find("set \"C factor\" to -1") != std::string::npos);
  files.options.set("C factor", -1.0);
  TEST_ASSERT(read_system(files.options, world(), at_once).remarks.empty());
}

TEUCHOS_UNIT_TEST(read_system, a_node_map_makes_the_order_of_the_files_irrelevant) {
  const Order vectors = mixed(n_vector), scalars = mixed(n_nodes);
  Files files(vectors, scalars);
  std::string map = "# node component\n";
  for (const int i : vectors)  // numbers with gaps
    map += std::to_string(7 + 1000 * (i / 2)) + " " + std::to_string(i % 2) + "\n";
  for (const int k : scalars) map += std::to_string(7 + 1000 * k) + "\n";
  files.set("node map", map);
  TEST_ASSERT(is_dealt(files, Files()));
}

TEUCHOS_UNIT_TEST(read_system, components_follow_the_order_of_the_lines_where_none_is_named) {
  Files files;
  std::string map;
  for (int i = 0; i < n_vector; ++i) map += std::to_string(i / 2) + "\n";
  for (int k = 0; k < n_nodes; ++k) map += std::to_string(k) + "\n";
  files.set("node map", map);
  TEST_ASSERT(is_dealt(files, Files()));
}

TEUCHOS_UNIT_TEST(read_system, fewer_scalars_than_nodes_have_a_graph_of_their_own) {
  const Files files(natural(n_vector), natural(n_nodes - 2));
  const System system = read_system(files.options, world(), at_once);
  const auto &vectors = (*system.K.space())[0].nodes, &scalars = (*system.K.space())[1].nodes;
  TEST_EQUALITY(static_cast<int>(vectors.graph->getGlobalNumRows()), n_nodes);
  TEST_EQUALITY(static_cast<int>(scalars.graph->getGlobalNumRows()), n_nodes - 2);
  TEST_ASSERT(is_dealt(files));
}

TEUCHOS_UNIT_TEST(read_system, a_solution_goes_back_to_the_order_of_the_files) {
  const Order vectors = mixed(n_vector);
  Files files(vectors);
  std::string map;
  for (const int i : vectors) map += std::to_string(i / 2) + " " + std::to_string(i % 2) + "\n";
  for (int k = 0; k < n_nodes; ++k) map += std::to_string(k) + "\n";
  files.set("node map", map);
  const System system = read_system(files.options, world(), at_once);
  const Vector b = in_file_order(system, system.b);
  const auto view = b.getLocalViewHost(read_only);
  TEST_EQUALITY(view.extent(0), world()->getRank() == 0 ? std::size_t{n_vector + n_nodes} : 0U);
  for (std::size_t i = 0; i < view.extent(0); ++i)
    TEST_EQUALITY(view(i, 0), i < n_vector ? vectors[i] : 100.0 + (i - n_vector));
}

/// Column j of row a: a + 10 j.
std::string dense(int rows, int columns) {
  std::string text = "%%MatrixMarket matrix array real general\n" + std::to_string(rows) + " " +
                     std::to_string(columns) + "\n";
  for (int j = 0; j < columns; ++j)
    for (int a = 0; a < rows; ++a) text += std::to_string(a + 10 * j) + "\n";
  return text;
}

TEUCHOS_UNIT_TEST(read_system, coordinates_go_to_the_ranks_of_their_nodes) {
  Files files(natural(n_vector), natural(n_vector / 3));
  files.options.set("components", 3);
  files.set("coordinates", dense(n_vector / 3, 3));
  const System system = read_system(files.options, world(), at_once);
  for (const int block : {0, 1}) {
    const algebra::Nodes& nodes = (*system.K.space())[block].nodes;
    const auto x = nodes.places.coordinates->getLocalViewHost(read_only);
    const auto in_solid = nodes.places.in_solid->getLocalViewHost(read_only);
    TEST_EQUALITY(x.extent(0), n_local(*nodes.graph->getRowMap()));
    for (std::size_t a = 0; a < x.extent(0); ++a) {
      const auto node = nodes.graph->getRowMap()->getGlobalElement(static_cast<LocalOrdinal>(a));
      for (int j = 0; j < 3; ++j) TEST_EQUALITY(x(a, j), static_cast<double>(node + 10 * j));
      TEST_EQUALITY(in_solid(a, 0), 1.0);
    }
  }
  const auto reason = [&](int rows, int columns, int components) {
    files.set("coordinates", dense(rows, columns));
    files.options.set("components", components);
    return refusal([&] { read_system(files.options, world(), at_once); });
  };
  TEST_ASSERT(says(reason(5, 3, 3), "5 rows, expected one for each of 6 nodes"));
  TEST_ASSERT(says(reason(6, 2, 3), "there are 2 columns, expected 3"));
  TEST_ASSERT(says(reason(9, 3, 2), "vectors of three components, these have 2"));
}

TEUCHOS_UNIT_TEST(read_system, what_does_not_fit_is_told_to_all_ranks) {
  const auto reason = [](const char* key, const std::string& text) {
    Files files;
    files.set(key, text);
    return refusal([&] { read_system(files.options, world(), at_once); });
  };
  const auto map = [](int from, const std::string& other) {  // other in the place of one line
    std::string lines;
    for (int i = 0; i < n_vector + n_nodes; ++i)
      lines += i == from ? other : std::to_string(i < n_vector ? i / 2 : i - n_vector) + "\n";
    return lines;
  };
  const Order some = natural(n_nodes - 1);
  TEST_ASSERT(
      says(reason("A", text_of(b2, some, natural(n_vector))), "A is 8 x 18, expected 8 x 8"));
  TEST_ASSERT(says(reason("B1T", text_of(b2, some, natural(n_vector))), "B1T is 8 x 18"));
  TEST_ASSERT(says(reason("C", text_of(c, some, some)), "C is 8 x 8, expected 9 x 9"));
  TEST_ASSERT(says(reason("rhs", "%%MatrixMarket matrix array real general\n1 1\n7\n"),
                   "rhs has 1 rows, expected 27"));
  TEST_ASSERT(says(reason("node map", map(11, "junk\n")), ", line 12: expected the number"));
  TEST_ASSERT(says(reason("node map", map(26, "")), "26 unknowns, expected 18 of A and 9 of B2"));
  TEST_ASSERT(says(reason("node map", map(26, "8\n9\n")), "28 unknowns, expected 18"));
  TEST_ASSERT(says(reason("node map", map(11, "5 0\n")),
                   ", line 12: node 5 has two unknowns of component 0"));
  TEST_ASSERT(says(reason("node map", map(11, "0\n")),
                   ", line 12: component 2 of node 0, but \"components\" is 2"));
  TEST_ASSERT(
      says(reason("node map", map(20, "1\n")), ", line 21: node 1 has two scalar unknowns"));
}

TEUCHOS_UNIT_TEST(read_system, more_ranks_than_nodes_are_refused) {
  Files files(natural(2), natural(1));
  const std::string reason = refusal([&] { read_system(files.options, world()); });
  TEST_ASSERT(says(reason, world()->getSize() > 1 ? "Use fewer ranks" : ""));
}

}  // namespace
