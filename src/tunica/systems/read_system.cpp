#include "tunica/systems/read_system.hpp"

#include <Teuchos_CommHelpers.hpp>
#include <algorithm>
#include <string>

#include "tunica/base/agreement.hpp"
#include "tunica/base/error.hpp"
#include "tunica/base/exchange.hpp"
#include "tunica/base/map_of.hpp"
#include "tunica/base/sort_once.hpp"
#include "tunica/base/trilinos.hpp"
#include "tunica/systems/matrix_files.hpp"
#include "tunica/systems/node_graph.hpp"
#include "tunica/systems/node_partition.hpp"

namespace tunica::systems {

namespace {

/// The unknowns of a block or the nodes of a kind: their numbers, in the order of the file, and
/// the rank of each.
struct Rows {
  std::vector<GlobalOrdinal> numbers;
  std::vector<int> ranks;
};

/// All that rank 0 reads.
struct Files {
  FileMatrix A, B1T, B2, mC;
  std::vector<double> b;
  NodeGraph vector_graph, scalar_graph;
  Rows vectors, scalars, vector_nodes, scalar_nodes;
  bool is_shared = false;
};

std::string size_of(const FileMatrix& A) {
  return std::to_string(A.n_rows) + " x " + std::to_string(A.n_columns);
}

void check_size(const std::string& name, const FileMatrix& block, long long n_rows,
                long long n_columns) {
  TUNICA_CHECK(block.n_rows == n_rows && block.n_columns == n_columns,
               "System: " + name + " is " + size_of(block) + ", expected " +
                   std::to_string(n_rows) + " x " + std::to_string(n_columns) + ".");
}

/// Factors need a diagonal even where it is zero.
FileMatrix with_diagonal(const FileMatrix& A, double factor) {
  FileMatrix result = empty_matrix(A.n_rows, A.n_columns);
  for (long long i = 0; i < A.n_rows; ++i) {
    const auto first = A.columns.begin() + static_cast<std::ptrdiff_t>(A.start[i]);
    const auto last = A.columns.begin() + static_cast<std::ptrdiff_t>(A.start[i + 1]);
    const bool is_missing = std::find(first, last, i) == last;
    for (std::size_t k = A.start[i]; k < A.start[i + 1]; ++k) {
      result.columns.push_back(A.columns[k]);
      result.values.push_back(factor * A.values[k]);
    }
    if (is_missing) {
      result.columns.push_back(i);
      result.values.push_back(0.0);
    }
    result.start[i + 1] = result.columns.size();
  }
  return result;
}

/// The nodes that have unknowns of a kind.
Rows nodes_of(const std::vector<long long>& node_of_unknown, const std::vector<int>& ranks) {
  std::vector<long long> nodes = node_of_unknown;
  sort_once(nodes);
  Rows rows;
  for (const long long node : nodes) {
    rows.numbers.push_back(node);
    rows.ranks.push_back(ranks[node]);
  }
  return rows;
}

Files read_files(const Teuchos::ParameterList& options, int ranks) {
  const auto path = [&](const char* key) { return options.get<std::string>(key); };
  Files files;
  files.A = with_diagonal(read_matrix(path("A")), 1.0);
  check_size("A", files.A, files.A.n_rows, files.A.n_rows);
  files.B2 = read_matrix(path("B2"));
  const long long n = files.A.n_rows, m = files.B2.n_rows;
  check_size("B2", files.B2, m, n);
  files.B1T = path("B1T").empty() ? transposed(files.B2) : read_matrix(path("B1T"));
  check_size("B1T", files.B1T, n, m);
  const FileMatrix C = path("C").empty() ? empty_matrix(m, m) : read_matrix(path("C"));
  check_size("C", C, m, m);
  files.mC = with_diagonal(C, -options.get<double>("C factor"));
  files.b = read_column(path("rhs"));
  TUNICA_CHECK(static_cast<long long>(files.b.size()) == n + m,
               "System: rhs has " + std::to_string(files.b.size()) + " rows, expected " +
                   std::to_string(n + m) + ": those of A, then those of B2.");

  const NodeTable table = make_node_table(options, n, m);
  files.is_shared = table.is_shared;
  files.vector_graph = vector_graph(files.A, table);
  files.scalar_graph = table.is_shared
                           ? files.vector_graph
                           : scalar_graph(files.A, files.B1T, files.B2, files.mC, table);
  const NodePartition parts = partition_nodes(files.vector_graph, files.B2, table, ranks);
  files.vector_nodes = nodes_of(table.vector_node, parts.vectors);
  files.scalar_nodes = nodes_of(table.scalar_node, parts.scalars);
  for (long long k = 0; k < n; ++k) {
    files.vectors.numbers.push_back(table.components * table.vector_node[k] + table.component[k]);
    files.vectors.ranks.push_back(parts.vectors[table.vector_node[k]]);
  }
  for (const long long node : table.scalar_node) {
    files.scalars.numbers.push_back(node);
    files.scalars.ranks.push_back(parts.scalars[node]);
  }
  return files;
}

/// Where rows stand in the file, all on rank 0, and where they go.
struct Move {
  Teuchos::RCP<const Map> root, spread;

  /// rows: none but on rank 0.
  Move(const Rows& rows, const CommPtr& comm) : root(map_of(rows.numbers, comm)) {
    std::vector<GlobalOrdinal> mine = exchange_to(*comm, rows.numbers, rows.ranks).items;
    std::sort(mine.begin(), mine.end());
    spread = map_of(mine, comm);
  }
};

/// Of a matrix or a graph.
template <class Sparse>
Teuchos::RCP<Sparse> spread(const Teuchos::RCP<Sparse>& on_root, const Move& rows,
                            const Move& columns) {
  on_root->fillComplete(columns.root, rows.root);
  const auto result = Teuchos::rcp(new Sparse(rows.spread, on_root->getGlobalMaxNumRowEntries()));
  result->doImport(*on_root, Import(rows.root, rows.spread), insert);
  result->fillComplete(columns.spread, rows.spread);
  return result;
}

Teuchos::RCP<CrsMatrix> spread(const FileMatrix& A, const Move& rows, const Move& columns) {
  std::size_t longest = 0;
  for (std::size_t i = 0; i + 1 < A.start.size(); ++i)
    longest = std::max(longest, A.start[i + 1] - A.start[i]);
  const auto on_root = Teuchos::rcp(new CrsMatrix(rows.root, longest));
  std::vector<GlobalOrdinal> numbers;
  for (std::size_t i = 0; i + 1 < A.start.size(); ++i) {
    numbers.clear();
    for (std::size_t k = A.start[i]; k < A.start[i + 1]; ++k)
      numbers.push_back(columns.root->getGlobalElement(static_cast<int>(A.columns[k])));
    on_root->insertGlobalValues(
        rows.root->getGlobalElement(static_cast<int>(i)), Teuchos::arrayViewFromVector(numbers),
        Teuchos::arrayView(A.values.data() + A.start[i], static_cast<int>(numbers.size())));
  }
  return spread(on_root, rows, columns);
}

algebra::Nodes spread(const NodeGraph& graph, const Move& nodes) {
  std::size_t longest = 0;
  for (const auto& neighbours : graph) longest = std::max(longest, neighbours.size());
  const auto on_root = Teuchos::rcp(new CrsGraph(nodes.root, longest));
  for (const GlobalOrdinal node : global_numbers(*nodes.root))
    on_root->insertGlobalIndices(node, Teuchos::arrayViewFromVector(graph[node]));
  const auto order = Teuchos::rcp(new Vector(nodes.spread));
  for (const GlobalOrdinal node : global_numbers(*nodes.spread))
    order->replaceGlobalValue(node, static_cast<Scalar>(node));
  return {spread(on_root, nodes, nodes), order};
}

Teuchos::RCP<Vector> spread(const double* values, const Move& rows) {
  Vector on_root(rows.root);
  {
    const auto to = on_root.getLocalViewHost(overwrite_all);
    for (std::size_t i = 0; i < to.extent(0); ++i) to(i, 0) = values[i];
  }
  const auto result = Teuchos::rcp(new Vector(rows.spread));
  result->doImport(on_root, Import(rows.root, rows.spread), insert);
  return result;
}

}  // namespace

params::Table system_table() {
  params::Table table("A block system [A B1T; B2 -C] in the Matrix Market format.");
  table.file("A", std::nullopt, "the square block of the vector unknowns")
      .file("B1T", "", "the block right of A; the transpose of B2 where there is no file")
      .file("B2", std::nullopt, "the block below A")
      .file("C", "", "the square block of the scalar unknowns; zero where there is no file")
      .number("C factor", 1.0, params::any(), "1",
              "K has -(C factor) C; -1 where the file holds the block as it stands in K")
      .file("rhs", std::nullopt, "right-hand side: one column, the rows of A, then those of B2")
      .integer("components", 3, params::between(1, 16), "vector unknowns of a node")
      .choice("order", "by node", {"by node", "by component"},
              "numbers of the vector unknowns: components*node + i, or i*nodes + node; scalar "
              "unknowns are numbered by their nodes")
      .file("node map", "",
            "text file, for systems in no such order: a line for each unknown, those of A first, "
            "with the number of its node and, for vector unknowns, the component (counted from 0; "
            "without it in the order of the lines)");
  return table;
}

System read_system(const Teuchos::ParameterList& options, const CommPtr& comm) {
  Files files;
  on_root(*comm, [&] { files = read_files(options, comm->getSize()); });
  int is_shared = files.is_shared ? 1 : 0;
  Teuchos::broadcast(*comm, 0, &is_shared);
  const Move vectors(files.vectors, comm), scalars(files.scalars, comm);
  const Move vector_nodes(files.vector_nodes, comm), scalar_nodes(files.scalar_nodes, comm);
  const algebra::Nodes at_vectors = spread(files.vector_graph, vector_nodes);
  const algebra::Nodes at_scalars =
      is_shared != 0 ? at_vectors : spread(files.scalar_graph, scalar_nodes);
  const int components = options.get<int>("components");
  const auto space = [&](auto map_of_move) {
    return std::make_shared<const algebra::BlockSpace>(
        std::vector<algebra::Block>{{"vector", map_of_move(vectors), components, at_vectors},
                                    {"scalar", map_of_move(scalars), 1, at_scalars}});
  };
  System system;
  system.K = algebra::BlockMatrix(space([](const Move& move) { return move.spread; }));
  system.K.set(0, 0, spread(files.A, vectors, vectors));
  system.K.set(0, 1, spread(files.B1T, vectors, scalars));
  system.K.set(1, 0, spread(files.B2, scalars, vectors));
  system.K.set(1, 1, spread(files.mC, scalars, scalars));
  system.b = algebra::BlockVector(
      system.K.space(),
      {spread(files.b.data(), vectors), spread(files.b.data() + files.A.n_rows, scalars)});
  system.file_space = space([](const Move& move) { return move.root; });
  return system;
}

algebra::BlockVector in_file_order(const System& system, const algebra::BlockVector& x) {
  algebra::BlockVector in_order(system.file_space);
  for (int b = 0; b < x.n_blocks(); ++b)
    in_order[b].doImport(x[b], Import(x[b].getMap(), in_order[b].getMap()), insert);
  return in_order;
}

}  // namespace tunica::systems
