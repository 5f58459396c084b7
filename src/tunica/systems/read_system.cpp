#include "tunica/systems/read_system.hpp"

#include <algorithm>
#include <string>

#include "tunica/base/error.hpp"
#include "tunica/base/map_of.hpp"
#include "tunica/base/reduce.hpp"
#include "tunica/base/trilinos.hpp"
#include "tunica/systems/check_blocks.hpp"
#include "tunica/systems/dealt_rows.hpp"
#include "tunica/systems/matrix_files.hpp"
#include "tunica/systems/node_graph.hpp"
#include "tunica/systems/node_partition.hpp"
#include "tunica/systems/null_space.hpp"
#include "tunica/systems/preparation.hpp"
#include "tunica/systems/unknown_order.hpp"
#include "tunica/systems/whole_matrix.hpp"

namespace tunica::systems {

namespace {

void check_size(const std::string& name, const SparseRows& block, long long n_rows,
                long long n_columns) {
  const auto size = [](long long rows, long long columns) {
    return std::to_string(rows) + " x " + std::to_string(columns);
  };
  TUNICA_CHECK(block.n_rows == n_rows && block.n_columns == n_columns,
               "System: " + name + " is " + size(block.n_rows, block.n_columns) + ", expected " +
                   size(n_rows, n_columns) + ".");
}

/// Rows of b to the portions of a block whose rows begin there. Collective.
std::vector<double> rows_of_block(const ColumnRows& b, long long begin, long long count,
                                  const Comm& comm) {
  const Portion mine = portion_of(b.n_rows, comm);
  const auto place = [&](long long row) {
    return b.values.begin() + (std::clamp(row, mine.first, mine.first + mine.count) - mine.first);
  };
  return spread(comm, std::vector<double>(place(begin), place(begin + count)),
                std::max(mine.first - begin, 0LL), count);
}

void number_rows(Blocks& blocks) {
  for (const int i : {0, 1})
    for (std::size_t k = 0; k < blocks.n_local(i); ++k)
      blocks.file_rows[i].push_back(blocks(i, i).first_row() + static_cast<long long>(k));
}

Blocks read_blocks(const Teuchos::ParameterList& options, const CommPtr& comm,
                   std::size_t lines_at_once) {
  const auto path = [&](const char* key) { return options.get<std::string>(key); };
  const auto read = [&](const char* key) { return read_matrix(path(key), comm, lines_at_once); };
  Blocks blocks;
  blocks.A = read("A");
  check_size("A", blocks.A, blocks.A.n_rows, blocks.A.n_rows);
  blocks.A = with_diagonal(blocks.A);
  blocks.B2 = read("B2");
  const long long n = blocks.A.n_rows, m = blocks.B2.n_rows;
  check_size("B2", blocks.B2, m, n);
  blocks.B1T = path("B1T").empty() ? transposed(blocks.B2) : read("B1T");
  check_size("B1T", blocks.B1T, n, m);
  const MatrixRows C = path("C").empty() ? empty_matrix(m, m, comm) : read("C");
  check_size("C", C, m, m);
  blocks.mC = with_diagonal(C);
  for (double& value : blocks.mC.values) value *= -options.get<double>("C factor");
  const ColumnRows b = read_column(path("rhs"), comm, lines_at_once);
  TUNICA_CHECK(b.n_rows == n + m, "System: rhs has " + std::to_string(b.n_rows) +
                                      " rows, expected " + std::to_string(n + m) +
                                      ": those of A, then those of B2.");
  blocks.b = {rows_of_block(b, 0, n, *comm), rows_of_block(b, n, m, *comm)};
  number_rows(blocks);
  return blocks;
}

/// Where the unknowns of the files go.
struct Places {
  Deal vectors, scalars;
  algebra::Nodes at_vectors, at_scalars;
  int components;
  bool has_scalars;

  algebra::BlockSpacePtr space(bool is_dealt) const {
    const auto map = [&](const Deal& deal) { return is_dealt ? deal.dealt : deal.portions; };
    std::vector<algebra::Block> blocks{{"vector", map(vectors), components, at_vectors}};
    if (has_scalars) blocks.push_back({"scalar", map(scalars), 1, at_scalars});
    return std::make_shared<const algebra::BlockSpace>(blocks);
  }
  const Deal& deal(int field) const { return field == 0 ? vectors : scalars; }
};

Places places_of(const Blocks& blocks, const NodeTable& table) {
  const CommPtr comm = blocks.A.comm;
  const NodeGraph graph = vector_graph(blocks, table);
  const NodePartition parts = partition_nodes(graph, blocks.B2, table);
  const bool has_scalars = blocks.n_rows(1) > 0;
  std::vector<GlobalOrdinal> numbers;
  for (std::size_t k = 0; k < table.vector_node.size(); ++k)
    numbers.push_back(table.components * table.vector_node[k] + table.component[k]);
  const algebra::Nodes at_vectors = dealt(graph, parts.vector_nodes);
  return {Deal(numbers, parts.vectors, comm),
          Deal(table.scalar_node, parts.scalars, comm),
          at_vectors,
          table.is_shared || !has_scalars ? at_vectors
                                          : dealt(scalar_graph(blocks, table), parts.scalar_nodes),
          table.components,
          has_scalars};
}

System deal_out(Blocks blocks, const Preparation& preparation, const Places& places) {
  System system;
  const algebra::BlockSpacePtr space = places.space(true);
  const int fields = space->n_blocks();
  const auto vector = [&](const OfUnknowns& values) {
    std::vector<Teuchos::RCP<Vector>> parts;
    for (int i = 0; i < fields; ++i) parts.push_back(dealt(values[i], places.deal(i)));
    return algebra::BlockVector(space, parts);
  };
  system.b = vector(blocks.b);
  system.known = vector(preparation.known);
  system.is_known = vector(preparation.is_known);
  system.scale = vector(preparation.scale);
  system.K = algebra::BlockMatrix(space);
  for (int i = 0; i < fields; ++i)
    for (int j = 0; j < fields; ++j)
      system.K.set(i, j, dealt(std::move(blocks(i, j)), places.deal(i), places.deal(j)));
  system.file_space = places.space(false);
  return system;
}

void check_files(const Teuchos::ParameterList& list, const std::string& path) {
  const auto is_given = [&](const char* key) { return !list.get<std::string>(key).empty(); };
  const bool has_block = is_given("A") || is_given("B2") || is_given("B1T") || is_given("C");
  TUNICA_CHECK(is_given("K") || has_block,
               path + ": \"K\" is missing, expected a file, or A, B2 and rhs in its place.");
  TUNICA_CHECK(!is_given("K") || !has_block,
               path + ": \"K\" has all unknowns, expected no A, B1T, B2 and C beside it.");
  for (const char* key : {"A", "B2", "rhs"})
    TUNICA_CHECK(is_given("K") || is_given(key),
                 path + ": \"" + key +
                     "\" is missing, expected a file; one matrix with all unknowns is \"K\".");
}

/// In the order in which each needs what is before it.
void prepare(Blocks& blocks, const Teuchos::ParameterList& options, Preparation& preparation) {
  const double negligible = options.get<double>("negligible");
  if (negligible > 0.0) drop_negligible(blocks, negligible, preparation);
  const bool is_scaled = options.get<std::string>("scaling") == "fields";
  if (is_scaled) scale_fields(blocks, preparation);
  if (options.get<bool>("known values")) take_out_known(blocks, preparation);
  if (is_scaled) scale_outlying_rows(blocks, preparation);
}

}  // namespace

params::Table system_table() {
  params::Table table(
      "A system in the Matrix Market format: the blocks of [A B1T; B2 -C], or one matrix K.");
  table
      .file("K", "",
            "one matrix with all unknowns, of vectors and scalars or of one kind, in place of "
            "blocks")
      .choice("scalars", "automatic",
              {"automatic", "none", "first", "last", "first in node", "last in node"},
              "where the scalar unknowns stand in K; automatic: found from its signs")
      .integer("scalar unknowns", 0, params::between(0, 1e9),
               "number of scalars that stand first or last; 0: one for each node")
      .file("A", "", "the square block of the vector unknowns")
      .file("B1T", "", "the block right of A; the transpose of B2 if there is no file")
      .file("B2", "", "the block below A")
      .file("C", "", "the square block of the scalar unknowns; zero if there is no file")
      .number("C factor", 1.0, params::any(), "1",
              "K has -(C factor) C; -1 if the file contains the block as it is in K")
      .file("rhs", "",
            "right-hand side: one column, the rows of A, then those of B2, or those of K; without "
            "a file, with K alone, that of the solution sin(i) in row i")
      .integer("components", 0, params::between(0, 16),
               "vector unknowns of a node; 0: found from the pattern of A")
      .choice("order", "automatic", {"automatic", "by node", "by component"},
              "numbers of the vector unknowns: components*node + i, or i*nodes + node; scalar "
              "unknowns are numbered by their nodes; automatic: found from the pattern of A")
      .file("node map", "",
            "text file, for systems in no such order: a line for each unknown, those of A first, "
            "with the number of its node and, for vector unknowns, the component (counted from 0; "
            "without it in the order of the lines)")
      .number("negligible", 1e-14, params::Range{0.0, 1e-3, false, false}, "1",
              "entries of at most this part of the largest one of their row and of their column "
              "are left out; 0: none")
      .flag("known values", true,
            "take unknowns out of the system whose rows give their values: rows with nothing but "
            "the diagonal, and penalties")
      .choice("scaling", "fields", {"fields", "none"},
              "factors for the rows and columns of each field that make typical entries 1, and for "
              "rows that are much larger or smaller than others; none: as in the files")
      .flag("null space", true,
            "find scalars, or a component of the vectors, that are determined but for a constant, "
            "and take those of zero mean")
      .check(check_files);
  return table;
}

System read_system(const Teuchos::ParameterList& options, const CommPtr& comm,
                   std::size_t lines_at_once) {
  const bool is_whole = !options.get<std::string>("K").empty();
  std::string order;
  Blocks blocks = is_whole ? read_whole(options, comm, lines_at_once, order)
                           : read_blocks(options, comm, lines_at_once);
  Preparation preparation(blocks);
  for (const std::string& remark :
       {doubt_sign_of_C(blocks), fill_empty_rows(blocks, preparation.is_known)})
    if (!remark.empty()) preparation.remarks.push_back(remark);
  prepare(blocks, options, preparation);
  const VectorOrder vectors = find_components(blocks.A, blocks.n_rows(1), options);
  Teuchos::ParameterList with_order(options);
  with_order.set("components", vectors.components)
      .set<std::string>("order", vectors.is_by_node ? "by node" : "by component");
  const NodeTable table =
      make_node_table(with_order, blocks.n_rows(0), blocks.n_rows(1), comm, lines_at_once);
  std::vector<ConstantMode> constants;
  if (options.get<bool>("null space")) constants = hold_constants(blocks, table, preparation);
  const Places places = places_of(blocks, table);
  const auto file_rows = blocks.file_rows;
  System system = deal_out(std::move(blocks), preparation, places);
  system.remarks = std::move(preparation.remarks);
  system.notes = std::move(preparation.notes);
  system.constants = std::move(constants);
  system.order = vectors.text + (order.empty() ? "" : ", " + order);
  system.found.set("components", vectors.components)
      .set<std::string>("order", vectors.is_by_node ? "by node" : "by component");
  if (is_whole) system.file_rows = file_rows;
  return system;
}

algebra::BlockVector in_units_of_files(const System& system, const algebra::BlockVector& y) {
  algebra::BlockVector x = system.K.zero();
  // x = x_k + C y
  for (int i = 0; i < y.n_blocks(); ++i) {
    x[i].elementWiseMultiply(1.0, system.scale[i], y[i], 0.0);
    x[i].update(1.0, system.known[i], 1.0);
  }
  for (const ConstantMode& mode : system.constants) {
    const auto values = x[mode.field].getLocalViewHost(read_write);
    const auto is_known = system.is_known[mode.field].getLocalViewHost(read_only);
    const auto numbers = global_numbers(*x[mode.field].getMap());
    const int components = (*system.K.space())[mode.field].components;
    const auto is_in = [&](std::size_t k) {
      return is_known(k, 0) == 0.0 && numbers[k] % components == mode.component;
    };
    double sum = 0.0, count = 0.0;
    for (std::size_t k = 0; k < values.extent(0); ++k)
      if (is_in(k)) sum += values(k, 0), ++count;
    const double mean = global_sum(*system.K.comm(), sum) / global_sum(*system.K.comm(), count);
    for (std::size_t k = 0; k < values.extent(0); ++k)
      if (is_in(k)) values(k, 0) -= mean;
  }
  return x;
}

Vector in_file_order(const System& system, const algebra::BlockVector& x) {
  const CommPtr comm = system.K.comm();
  const GlobalOrdinal n = system.K.n_unknowns();
  const auto on_root = [&](GlobalOrdinal count) {
    return static_cast<std::size_t>(comm->getRank() == 0 ? count : 0);
  };
  Vector in_order(Teuchos::rcp(new Map(n, on_root(n), 0, comm)));
  const auto to = in_order.getLocalViewHost(overwrite_all);
  for (int b = 0, first = 0; b < x.n_blocks(); ++b) {
    const auto numbers = global_numbers(*(*system.file_space)[b].map);
    const auto all = gather_rows(*comm, std::vector<GlobalOrdinal>(numbers.begin(), numbers.end()));
    Vector block(map_of(all, comm));
    block.doImport(x[b], Import(x[b].getMap(), block.getMap()), insert);
    const auto from = block.getLocalViewHost(read_only);
    const std::vector<long long> rows = gather_rows(*comm, system.file_rows[b]);
    for (std::size_t k = 0; k < all.size(); ++k)
      to(rows.empty() ? first + k : static_cast<std::size_t>(rows[k]), 0) = from(k, 0);
    first += static_cast<int>(all.size());
  }
  return in_order;
}

}  // namespace tunica::systems
