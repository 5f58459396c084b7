#include "tunica/systems/read_system.hpp"

#include <algorithm>
#include <string>

#include "tunica/base/error.hpp"
#include "tunica/base/map_of.hpp"
#include "tunica/base/trilinos.hpp"
#include "tunica/systems/check_blocks.hpp"
#include "tunica/systems/dealt_rows.hpp"
#include "tunica/systems/matrix_files.hpp"
#include "tunica/systems/node_graph.hpp"
#include "tunica/systems/node_partition.hpp"

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
  blocks.b = read_column(path("rhs"), comm, lines_at_once);
  TUNICA_CHECK(blocks.b.n_rows == n + m, "System: rhs has " + std::to_string(blocks.b.n_rows) +
                                             " rows, expected " + std::to_string(n + m) +
                                             ": those of A, then those of B2.");
  return blocks;
}

}  // namespace

params::Table system_table() {
  params::Table table("A block system [A B1T; B2 -C] in the Matrix Market format.");
  table.file("A", std::nullopt, "the square block of the vector unknowns")
      .file("B1T", "", "the block right of A; the transpose of B2 if there is no file")
      .file("B2", std::nullopt, "the block below A")
      .file("C", "", "the square block of the scalar unknowns; zero if there is no file")
      .number("C factor", 1.0, params::any(), "1",
              "K has -(C factor) C; -1 if the file contains the block as it is in K")
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

System read_system(const Teuchos::ParameterList& options, const CommPtr& comm,
                   std::size_t lines_at_once) {
  Blocks blocks = read_blocks(options, comm, lines_at_once);
  std::vector<std::string> remarks;
  for (const std::string& remark : {doubt_sign_of_C(blocks), fill_empty_rows(blocks)})
    if (!remark.empty()) remarks.push_back(remark);
  const long long n = blocks.A.n_rows, m = blocks.B2.n_rows;
  const NodeTable table = make_node_table(options, n, m, comm, lines_at_once);
  const NodeGraph graph = vector_graph(blocks.A, table);
  const NodePartition parts = partition_nodes(graph, blocks.B2, table);
  const algebra::Nodes at_vectors = dealt(graph, parts.vector_nodes);
  const algebra::Nodes at_scalars =
      table.is_shared ? at_vectors
                      : dealt(scalar_graph(blocks.A, blocks.B1T, blocks.B2, blocks.mC, table),
                              parts.scalar_nodes);
  std::vector<GlobalOrdinal> numbers;
  for (std::size_t k = 0; k < table.vector_node.size(); ++k)
    numbers.push_back(table.components * table.vector_node[k] + table.component[k]);
  const Deal vectors(numbers, parts.vectors, comm), scalars(table.scalar_node, parts.scalars, comm);
  const auto space = [&](const auto& vector_map, const auto& scalar_map) {
    return std::make_shared<const algebra::BlockSpace>(
        std::vector<algebra::Block>{{"vector", vector_map, table.components, at_vectors},
                                    {"scalar", scalar_map, 1, at_scalars}});
  };
  System system;
  system.remarks = std::move(remarks);
  system.K = algebra::BlockMatrix(space(vectors.dealt, scalars.dealt));
  system.K.set(0, 0, dealt(std::move(blocks.A), vectors, vectors));
  system.K.set(0, 1, dealt(std::move(blocks.B1T), vectors, scalars));
  system.K.set(1, 0, dealt(std::move(blocks.B2), scalars, vectors));
  system.K.set(1, 1, dealt(std::move(blocks.mC), scalars, scalars));
  system.b = algebra::BlockVector(system.K.space(),
                                  {dealt(rows_of_block(blocks.b, 0, n, *comm), vectors),
                                   dealt(rows_of_block(blocks.b, n, m, *comm), scalars)});
  system.file_space = space(vectors.portions, scalars.portions);
  return system;
}

algebra::BlockVector in_file_order(const System& system, const algebra::BlockVector& x) {
  std::vector<algebra::Block> blocks;
  for (int b = 0; b < x.n_blocks(); ++b) {
    const algebra::Block& block = (*system.file_space)[b];
    const auto numbers = global_numbers(*block.map);
    const CommPtr comm = block.map->getComm();
    const auto all = gather_rows(*comm, std::vector<GlobalOrdinal>(numbers.begin(), numbers.end()));
    blocks.push_back({block.name, map_of(all, comm), block.components});
  }
  algebra::BlockVector in_order(std::make_shared<const algebra::BlockSpace>(blocks));
  for (int b = 0; b < x.n_blocks(); ++b)
    in_order[b].doImport(x[b], Import(x[b].getMap(), in_order[b].getMap()), insert);
  return in_order;
}

}  // namespace tunica::systems
