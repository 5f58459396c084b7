#include "tunica/fields/block_operator.hpp"

#include <algorithm>

namespace tunica::fields {

NodeGraph make_node_graph(const FieldMesh& mesh) {
  std::vector<std::vector<int>> rows(mesh.n_owned);
  for (const auto& tet : mesh.tets)
    for (const int a : tet)
      if (a < mesh.n_owned) rows[a].insert(rows[a].end(), tet.begin(), tet.end());
  NodeGraph graph;
  graph.row_start.push_back(0);
  for (auto& row : rows) {
    std::sort(row.begin(), row.end());
    row.erase(std::unique(row.begin(), row.end()), row.end());
    graph.columns.insert(graph.columns.end(), row.begin(), row.end());
    graph.row_start.push_back(graph.columns.size());
  }
  for (const auto& tet : mesh.tets) {
    auto& position = graph.position.emplace_back();
    position.fill(-1);
    for (int a = 0; a < 4; ++a) {
      if (tet[a] >= mesh.n_owned) continue;
      const auto& row = rows[tet[a]];
      for (int b = 0; b < 4; ++b)
        position[4 * a + b] =
            static_cast<int>(std::lower_bound(row.begin(), row.end(), tet[b]) - row.begin());
    }
  }
  return graph;
}

Teuchos::RCP<CrsMatrix> make_matrix(const NodeGraph& graph, const FieldMesh& mesh, int dofs_row,
                                    int dofs_column) {
  using RowStart = CrsMatrix::local_graph_device_type::row_map_type::non_const_type;
  using Columns = CrsMatrix::local_graph_device_type::entries_type::non_const_type;
  using Values = CrsMatrix::local_matrix_device_type::values_type::non_const_type;
  const std::size_t pairs = graph.columns.size();
  RowStart row_start("row start", static_cast<std::size_t>(dofs_row) * mesh.n_owned + 1);
  Columns columns("columns", pairs * dofs_row * dofs_column);
  Values values("values", pairs * dofs_row * dofs_column);
  std::size_t next = 0;
  for (int a = 0; a < mesh.n_owned; ++a)
    for (int i = 0; i < dofs_row; ++i) {
      for (std::size_t k = graph.row_start[a]; k < graph.row_start[a + 1]; ++k)
        for (int j = 0; j < dofs_column; ++j) columns(next++) = dofs_column * graph.columns[k] + j;
      row_start(dofs_row * a + i + 1) = next;
    }
  const auto row_map = dofs_row == 3 ? mesh.vector_map : mesh.node_map;
  const auto domain_map = dofs_column == 3 ? mesh.vector_map : mesh.node_map;
  const auto column_map = dofs_column == 3 ? mesh.ghosted_vector_map : mesh.ghosted_map;
  const auto matrix = Teuchos::rcp(new CrsMatrix(row_map, column_map, row_start, columns, values));
  matrix->expertStaticFillComplete(domain_map, row_map);
  return matrix;
}

namespace {

algebra::BlockSpacePtr make_space(const FieldMesh& mesh, const NodalBlocks& blocks,
                                  const algebra::Nodes& nodes) {
  std::vector<algebra::Block> all;
  for (const NodalBlock& block : blocks)
    all.push_back({block.name, block.components == 3 ? mesh.vector_map : mesh.node_map,
                   block.components, nodes});
  return std::make_shared<const algebra::BlockSpace>(std::move(all));
}

/// Nodes are picked in the order of their vertices, whichever ranks own them.
Teuchos::RCP<const Vector> vertex_order(const FieldMesh& mesh) {
  const auto order = Teuchos::rcp(new Vector(mesh.node_map));
  const auto numbers = order->getLocalViewHost(overwrite_all);
  for (int a = 0; a < mesh.n_owned; ++a) numbers(a, 0) = mesh.vertex[a];
  return order;
}

}  // namespace

algebra::BlockSpacePtr nodal_space(const FieldMesh& mesh, const NodalBlocks& blocks) {
  return make_space(mesh, blocks, {});
}

BlockOperator::BlockOperator(const FieldMesh& mesh, const NodalBlocks& blocks)
    : mesh_(&mesh), graph_(make_node_graph(mesh)) {
  const int n = static_cast<int>(blocks.size());
  std::vector<Teuchos::RCP<CrsMatrix>> matrices;
  Teuchos::RCP<CrsMatrix> scalar;  // one row per node
  for (const NodalBlock& row : blocks)
    for (const NodalBlock& column : blocks) {
      matrices.push_back(make_matrix(graph_, mesh, row.components, column.components));
      if (row.components == 1 && column.components == 1 && scalar.is_null())
        scalar = matrices.back();
    }
  if (scalar.is_null()) scalar = make_matrix(graph_, mesh, 1, 1);
  algebra::BlockMatrix::operator=(
      algebra::BlockMatrix(make_space(mesh, blocks, {scalar, vertex_order(mesh)})));
  for (int i = 0; i < n; ++i)
    for (int j = 0; j < n; ++j) set(i, j, matrices[i * n + j]);
}

}  // namespace tunica::fields
