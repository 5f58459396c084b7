#include "tunica/fields/block_operator.hpp"

#include <algorithm>
#include <limits>
#include <stdexcept>

#include "tunica/base/error.hpp"

namespace tunica::fields {

NodeGraph make_node_graph(const FieldMesh& mesh) { return make_node_graph(mesh, mesh); }

NodeGraph make_node_graph(const FieldMesh& row_mesh, const FieldMesh& column_mesh) {
  std::vector<std::vector<int>> rows(row_mesh.n_owned);
  for (std::size_t e = 0; e < row_mesh.tets.size(); ++e)
    for (const int a : row_mesh.tets[e])
      if (a < row_mesh.n_owned)
        rows[a].insert(rows[a].end(), column_mesh.tets[e].begin(), column_mesh.tets[e].end());
  NodeGraph graph;
  graph.row_start.push_back(0);
  for (auto& row : rows) {
    std::sort(row.begin(), row.end());
    row.erase(std::unique(row.begin(), row.end()), row.end());
    if (row.size() > std::numeric_limits<std::int16_t>::max())
      throw std::length_error("a vertex has more than 32,767 neighbours");
    graph.columns.insert(graph.columns.end(), row.begin(), row.end());
    graph.row_start.push_back(graph.columns.size());
  }
  graph.position.resize(row_mesh.tets.size());
  for (std::size_t e = 0; e < row_mesh.tets.size(); ++e) {
    auto& position = graph.position[e];
    position.fill(-1);
    for (int a = 0; a < 4; ++a) {
      const int node = row_mesh.tets[e][a];
      if (node >= row_mesh.n_owned) continue;
      const auto& row = rows[node];
      for (int b = 0; b < 4; ++b) {
        const auto found = std::lower_bound(row.begin(), row.end(), column_mesh.tets[e][b]);
        position[4 * a + b] = static_cast<std::int16_t>(found - row.begin());
      }
    }
  }
  return graph;
}

namespace {

/// The nodes of rows or columns and how many of them each has.
struct Side {
  const FieldMesh* mesh;
  int dofs;

  Teuchos::RCP<const Map> map() const { return dofs == 3 ? mesh->vector_map : mesh->node_map; }
  Teuchos::RCP<const Map> ghosted_map() const {
    return dofs == 3 ? mesh->ghosted_vector_map : mesh->ghosted_map;
  }
};

Teuchos::RCP<CrsMatrix> matrix_between(const NodeGraph& graph, const Side& row,
                                       const Side& column) {
  using RowStart = CrsMatrix::local_graph_device_type::row_map_type::non_const_type;
  using Columns = CrsMatrix::local_graph_device_type::entries_type::non_const_type;
  using Values = CrsMatrix::local_matrix_device_type::values_type::non_const_type;
  const std::size_t pairs = graph.columns.size();
  const int n_rows = row.mesh->n_owned;
  RowStart row_start("row start", static_cast<std::size_t>(row.dofs) * n_rows + 1);
  Columns columns("columns", pairs * row.dofs * column.dofs);
  Values values("values", pairs * row.dofs * column.dofs);
  std::size_t next = 0;
  for (int a = 0; a < n_rows; ++a)
    for (int i = 0; i < row.dofs; ++i) {
      for (std::size_t k = graph.row_start[a]; k < graph.row_start[a + 1]; ++k)
        for (int j = 0; j < column.dofs; ++j) columns(next++) = column.dofs * graph.columns[k] + j;
      row_start(row.dofs * a + i + 1) = next;
    }
  const auto matrix =
      Teuchos::rcp(new CrsMatrix(row.map(), column.ghosted_map(), row_start, columns, values));
  matrix->expertStaticFillComplete(column.map(), row.map());
  return matrix;
}

/// Nodes are picked in the order of their vertices, whichever ranks own them.
Teuchos::RCP<const Vector> vertex_order(const FieldMesh& mesh) {
  const auto order = Teuchos::rcp(new Vector(mesh.node_map));
  const auto numbers = order->getLocalViewHost(overwrite_all);
  for (int a = 0; a < mesh.n_owned; ++a) numbers(a, 0) = mesh.vertex[a];
  return order;
}

template <class SideOf>
algebra::BlockSpacePtr space_of(const NodalBlocks& blocks, const SideOf& side_of,
                                const algebra::Nodes& vectors, const algebra::Nodes& scalars,
                                const MeshParts& parts = {}) {
  std::vector<algebra::Block> all;
  for (const NodalBlock& block : blocks)
    all.push_back({block.name, side_of(block).map(), block.components,
                   block.components == 1 ? scalars : vectors});
  return std::make_shared<const algebra::BlockSpace>(std::move(all), parts.names);
}

/// Where the vectors are that copies of a node belong to.
Teuchos::RCP<const Vector> hosts_of(const FieldMesh& mesh, const SplitMesh& split) {
  const auto hosts = Teuchos::rcp(new Vector(split.node_map));
  const auto numbers = hosts->getLocalViewHost(overwrite_all);
  for (int a = 0; a < split.n_owned; ++a)
    numbers(a, 0) = static_cast<Scalar>(mesh.node_map->getGlobalElement(split.node[a]));
  return hosts;
}

/// The part of each node; null where there are none.
Teuchos::RCP<const Vector> parts_of(const FieldMesh& mesh, const MeshParts& parts) {
  if (parts.names.empty()) return Teuchos::null;
  std::vector<int> part(mesh.n_nodes(), -1);
  const int between = static_cast<int>(parts.names.size()) - 1;
  for (std::size_t e = 0; e < mesh.tets.size(); ++e) {
    const int own = parts.of_region[mesh.region[e]];
    for (const int a : mesh.tets[e]) part[a] = part[a] == -1 || part[a] == own ? own : between;
  }
  const auto result = Teuchos::rcp(new Vector(mesh.node_map));
  const auto numbers = result->getLocalViewHost(overwrite_all);
  for (int a = 0; a < mesh.n_owned; ++a) numbers(a, 0) = part[a];
  return result;
}

}  // namespace

Teuchos::RCP<CrsMatrix> make_matrix(const NodeGraph& graph, const FieldMesh& mesh, int dofs_row,
                                    int dofs_column) {
  return matrix_between(graph, {&mesh, dofs_row}, {&mesh, dofs_column});
}

algebra::BlockSpacePtr nodal_space(const FieldMesh& mesh, const NodalBlocks& blocks) {
  return space_of(blocks,
                  [&mesh](const NodalBlock& block) {
                    return Side{&mesh, block.components};
                  },
                  {}, {});
}

BlockOperator::BlockOperator(const FieldMesh& mesh, const NodalBlocks& blocks,
                             const SplitMesh* split, const MeshParts& parts)
    : mesh_(&mesh), split_(split) {
  graphs_.fill(std::make_shared<const NodeGraph>(make_node_graph(mesh)));
  const auto side_of = [&](const NodalBlock& block) -> Side {
    return {split != nullptr && block.components == 1 ? split : &mesh, block.components};
  };
  if (split != nullptr) {
    graphs_[1] = std::make_shared<const NodeGraph>(make_node_graph(mesh, *split));
    graphs_[2] = std::make_shared<const NodeGraph>(make_node_graph(*split, mesh));
    graphs_[3] = std::make_shared<const NodeGraph>(make_node_graph(*split));
  }
  std::vector<Teuchos::RCP<CrsMatrix>> matrices;
  Teuchos::RCP<CrsMatrix> scalar;  // one row per node
  for (const NodalBlock& row : blocks)
    for (const NodalBlock& column : blocks) {
      const int kind = 2 * (row.components == 1) + (column.components == 1);
      matrices.push_back(matrix_between(*graphs_[kind], side_of(row), side_of(column)));
      if (kind == 3 && scalar.is_null()) scalar = matrices.back();
    }
  const bool is_shared = split == nullptr && !scalar.is_null();
  algebra::Nodes nodes{is_shared ? scalar : make_matrix(*graphs_[0], mesh, 1, 1),
                       vertex_order(mesh)};
  nodes.parts = parts_of(mesh, parts);
  algebra::Nodes copies = nodes;
  if (split != nullptr)
    copies = {scalar, vertex_order(*split), hosts_of(mesh, *split), parts_of(*split, parts)};
  algebra::BlockMatrix::operator=(
      algebra::BlockMatrix(space_of(blocks, side_of, nodes, copies, parts)));
  for (int i = 0; i < n_blocks(); ++i)
    for (int j = 0; j < n_blocks(); ++j) set(i, j, matrices[i * n_blocks() + j]);
}

const FieldMesh& BlockOperator::mesh_of(int block) const {
  return split_ != nullptr && (*space())[block].components == 1 ? *split_ : *mesh_;
}

const NodeGraph& BlockOperator::graph(int row, int column) const {
  const auto is_split = [this](int block) { return (*space())[block].components == 1 ? 1 : 0; };
  const auto& found = graphs_[2 * is_split(row) + is_split(column)];
  TUNICA_ASSERT(found != nullptr, "the graphs of the matrix are still there");
  return *found;
}

}  // namespace tunica::fields
