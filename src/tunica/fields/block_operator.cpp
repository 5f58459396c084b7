#include "tunica/fields/block_operator.hpp"

#include <algorithm>
#include <limits>
#include <numeric>
#include <stdexcept>
#include <utility>

#include "tunica/algebra/dof_layout.hpp"
#include "tunica/algebra/entry_offsets.hpp"
#include "tunica/algebra/static_matrix.hpp"
#include "tunica/base/error.hpp"
#include "tunica/base/map_of.hpp"
#include "tunica/base/reduce.hpp"
#include "tunica/base/trilinos.hpp"

namespace tunica::fields {

namespace {

/// The corners of elements at each owned node: 4 tet + a for corner a of the four.
struct Corners {
  std::vector<std::size_t> start;
  std::vector<int> corner;

  explicit Corners(const FieldMesh& mesh) : start(mesh.n_owned + 1, 0) {
    for (const auto& tet : mesh.tets)
      for (const int a : tet)
        if (a < mesh.n_owned) ++start[a + 1];
    std::partial_sum(start.begin(), start.end(), start.begin());
    std::vector<std::size_t> next(start.begin(), start.end() - 1);
    corner.resize(start.back());
    for (std::size_t e = 0; e < mesh.tets.size(); ++e)
      for (int a = 0; a < 4; ++a)
        if (const int node = mesh.tets[e][a]; node < mesh.n_owned)
          corner[next[node]++] = 4 * static_cast<int>(e) + a;
  }
};

}  // namespace

NodeGraph make_node_graph(const FieldMesh& mesh) { return make_node_graph(mesh, mesh); }

NodeGraph make_node_graph(const FieldMesh& row_mesh, const FieldMesh& column_mesh) {
  const Corners corners(row_mesh);
  NodeGraph graph;
  graph.row_start.reserve(row_mesh.n_owned + 1);
  graph.row_start.push_back(0);
  graph.position.resize(row_mesh.tets.size());
  for (auto& position : graph.position) position.fill(-1);
  std::vector<int> row, met(column_mesh.n_nodes(), -1);  // met: the last row that has the node
  std::vector<std::int16_t> place(column_mesh.n_nodes());
  for (int node = 0; node < row_mesh.n_owned; ++node) {
    const auto first = corners.corner.begin() + corners.start[node];
    const auto last = corners.corner.begin() + corners.start[node + 1];
    row.clear();
    for (auto c = first; c != last; ++c)
      for (const int column : column_mesh.tets[*c / 4])
        if (std::exchange(met[column], node) != node) row.push_back(column);
    if (row.size() > std::numeric_limits<std::int16_t>::max())
      throw std::length_error("a vertex has more than 32,767 neighbours");
    std::sort(row.begin(), row.end());
    for (std::size_t k = 0; k < row.size(); ++k) place[row[k]] = static_cast<std::int16_t>(k);
    for (auto c = first; c != last; ++c)
      for (int b = 0; b < 4; ++b)
        graph.position[*c / 4][4 * (*c % 4) + b] = place[column_mesh.tets[*c / 4][b]];
    graph.columns.insert(graph.columns.end(), row.begin(), row.end());
    graph.row_start.push_back(graph.columns.size());
  }
  return graph;
}

namespace {

/// Nodes are picked in the order of their vertices, whichever ranks own them.
Teuchos::RCP<const Vector> vertex_order(const FieldMesh& mesh) {
  const auto order = Teuchos::rcp(new Vector(mesh.node_map));
  const auto numbers = order->getLocalViewHost(overwrite_all);
  for (int a = 0; a < mesh.n_owned; ++a) numbers(a, 0) = mesh.vertex[a];
  return order;
}

algebra::BlockSpacePtr space_of(const FieldMesh& mesh, const SplitMesh* split,
                                const NodalBlocks& blocks, const algebra::Nodes& vectors,
                                const algebra::Nodes& scalars, const MeshParts& parts = {}) {
  std::vector<algebra::Block> all;
  for (const NodalBlock& block : blocks)
    if (block.components == 1)
      all.push_back({block.name, scalar_mesh(mesh, split).node_map, 1, scalars});
    else
      all.push_back({block.name, mesh.vector_map, block.components, vectors});
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

/// Nodes of a solid's elements, and where all nodes are; nothing without solids.
algebra::NodePlaces places_of(const FieldMesh& mesh, const std::vector<char>& is_solid) {
  if (std::find(is_solid.begin(), is_solid.end(), 1) == is_solid.end()) return {};
  std::vector<char> in_solid(mesh.n_nodes(), 0);
  for (std::size_t e = 0; e < mesh.tets.size(); ++e)
    if (is_solid[mesh.region[e]])
      for (const int a : mesh.tets[e]) in_solid[a] = 1;
  const auto x = Teuchos::rcp(new MultiVector(mesh.node_map, 3));
  const auto flags = Teuchos::rcp(new Vector(mesh.node_map));
  const auto coordinates = x->getLocalViewHost(overwrite_all);
  const auto flag = flags->getLocalViewHost(overwrite_all);
  for (int a = 0; a < mesh.n_owned; ++a) {
    for (int i = 0; i < 3; ++i) coordinates(a, i) = mesh.x[a][i];
    flag(a, 0) = in_solid[a];
  }
  return {x, flags};
}

}  // namespace

Teuchos::RCP<CrsGraph> make_graph(const NodeGraph& graph, const FieldMesh& mesh, int dofs_row,
                                  int dofs_column) {
  const std::size_t pairs = graph.columns.size();
  algebra::RowStart row_start("row start", static_cast<std::size_t>(dofs_row) * mesh.n_owned + 1);
  algebra::LocalColumns columns("columns", pairs * dofs_row * dofs_column);
  std::size_t next = 0;
  for (int a = 0; a < mesh.n_owned; ++a)
    for (int i = 0; i < dofs_row; ++i) {
      for (std::size_t k = graph.row_start[a]; k < graph.row_start[a + 1]; ++k)
        for (int j = 0; j < dofs_column; ++j) columns(next++) = dofs_column * graph.columns[k] + j;
      row_start(dofs_row * a + i + 1) = next;
    }
  return algebra::static_graph(mesh.owned_map(dofs_row), mesh.map_with_ghosts(dofs_column),
                               row_start, columns, mesh.owned_map(dofs_column));
}

Teuchos::RCP<CrsMatrix> make_matrix(const NodeGraph& graph, const FieldMesh& mesh, int dofs_row,
                                    int dofs_column) {
  return algebra::matrix_on(make_graph(graph, mesh, dofs_row, dofs_column));
}

algebra::BlockSpacePtr nodal_space(const FieldMesh& mesh, const NodalBlocks& blocks,
                                   const SplitMesh* split) {
  return space_of(mesh, split, blocks, {}, {});
}

namespace {

/// Numbers of a matrix between all unknowns; those of ghost nodes ascend behind those of owned
/// ones.
class MergedColumns {
public:
  MergedColumns(const BlockOperator& K, const algebra::DofLayout& layout,
                Teuchos::RCP<const Map> rows)
      : rows_(std::move(rows)),
        numbers_(global_numbers(*rows_).begin(), global_numbers(*rows_).end()) {
    std::vector<std::vector<GlobalOrdinal>> of_block;
    for (int b = 0; b < K.n_blocks(); ++b) {
      const int m = layout.components(b);
      of_block.push_back(layout.merged_numbers(*K.mesh_of(b).map_with_ghosts(m), b));
      numbers_.insert(numbers_.end(), of_block[b].begin() + m * K.mesh_of(b).n_owned,
                      of_block[b].end());
    }
    std::sort(numbers_.begin() + n_local(*rows_), numbers_.end());
    map_ = map_of(numbers_, K.mesh().comm);
    for (const auto& numbers : of_block) local_.push_back(algebra::local_numbers(numbers, *map_));
    for (int b = 0; b < K.n_blocks(); ++b) components_.push_back(layout.components(b));
  }

  const Teuchos::RCP<const Map>& rows() const { return rows_; }
  const Teuchos::RCP<const Map>& map() const { return map_; }
  /// The local number of component 0 at a node of a block.
  int first(int block, int node) const { return local_[block][components_[block] * node]; }

private:
  Teuchos::RCP<const Map> rows_, map_;
  std::vector<GlobalOrdinal> numbers_;
  std::vector<std::vector<int>> local_;  ///< of the unknowns of each block
  std::vector<int> components_;
};

/// Where a neighbour's unknowns stand in a row: the first of its columns.
struct MergedEntry {
  int column, block;
  std::size_t k;  ///< in the graph of the pair of blocks
};

/// graph: that of a pair of blocks. The rows of an owned node, in the order of columns.
template <class GraphOf>
void find_row(const GraphOf& graph, const MergedColumns& numbers, int n_blocks, int block, int node,
              std::vector<MergedEntry>& row) {
  row.clear();
  for (int c = 0; c < n_blocks; ++c) {
    const NodeGraph& own = graph(block, c);
    for (std::size_t k = own.row_start[node]; k < own.row_start[node + 1]; ++k)
      row.push_back({numbers.first(c, own.columns[k]), c, k});
  }
  std::sort(row.begin(), row.end(),
            [](const MergedEntry& x, const MergedEntry& y) { return x.column < y.column; });
}

template <class GraphOf>
algebra::RowStart merged_row_start(const BlockOperator& K, const GraphOf& graph,
                                   const algebra::DofLayout& layout, const MergedColumns& numbers) {
  algebra::RowStart row_start("row start", n_local(*numbers.rows()) + 1);
  std::size_t longest = 0;
  for (int b = 0; b < K.n_blocks(); ++b)
    for (int a = 0; a < K.mesh_of(b).n_owned; ++a) {
      std::size_t length = 0;
      for (int c = 0; c < K.n_blocks(); ++c) length += layout.components(c) * graph(b, c).length(a);
      longest = std::max(longest, length);
      for (int i = 0; i < layout.components(b); ++i)
        row_start(numbers.first(b, a) + i + 1) = length;
    }
  TUNICA_CHECK(global_max(*K.mesh().comm, static_cast<double>(longest)) <=
                   std::numeric_limits<std::int16_t>::max(),
               "a vertex of the mesh has more than 8,000 neighbours");
  for (std::size_t r = 1; r < row_start.extent(0); ++r) row_start(r) += row_start(r - 1);
  return row_start;
}

}  // namespace

/// Between the nodes of two blocks each, by whether these are on the split mesh; the same without
/// one.
struct BlockOperator::Graphs {
  std::array<std::shared_ptr<const NodeGraph>, 4> graphs;

  Graphs(const FieldMesh& mesh, const SplitMesh* split) {
    graphs.fill(std::make_shared<const NodeGraph>(make_node_graph(mesh)));
    if (split == nullptr) return;
    graphs[1] = std::make_shared<const NodeGraph>(make_node_graph(mesh, *split));
    graphs[2] = std::make_shared<const NodeGraph>(make_node_graph(*split, mesh));
    graphs[3] = std::make_shared<const NodeGraph>(make_node_graph(*split));
  }
  const NodeGraph& operator()(const algebra::BlockSpace& space, int row, int column) const {
    const auto is_scalar = [&space](int block) { return space[block].components == 1 ? 1 : 0; };
    return *graphs[2 * is_scalar(row) + is_scalar(column)];
  }
};

BlockOperator::BlockOperator(const FieldMesh& mesh, const NodalBlocks& blocks,
                             const SplitMesh* split, const MeshParts& parts)
    : mesh_(&mesh), split_(split) {
  const Graphs graphs(mesh, split);
  algebra::Nodes nodes{make_graph(*graphs.graphs[0], mesh), vertex_order(mesh)};
  nodes.parts = parts_of(mesh, parts);
  nodes.places = places_of(mesh, parts.is_solid);
  algebra::Nodes copies = nodes;
  if (split != nullptr)
    copies = {make_graph(*graphs.graphs[3], *split), vertex_order(*split), hosts_of(mesh, *split),
              parts_of(*split, parts)};
  algebra::BlockMatrix::operator=(
      algebra::BlockMatrix(space_of(mesh, split, blocks, nodes, copies, parts)));
  make_merged(graphs);
}

void BlockOperator::make_merged(const Graphs& graphs) {
  const algebra::DofLayout layout(*space());
  const MergedColumns numbers(*this, layout, layout.merged_map(*space()));
  const auto graph = [&](int row, int column) -> const NodeGraph& {
    return graphs(*space(), row, column);
  };
  const algebra::RowStart row_start = merged_row_start(*this, graph, layout, numbers);
  algebra::LocalColumns columns("columns", row_start(row_start.extent(0) - 1));
  rows_.resize(n_blocks());
  std::vector<std::vector<std::int16_t>> places;  // per pair of blocks and column of its graph
  for (int b = 0; b < n_blocks(); ++b)
    for (int c = 0; c < n_blocks(); ++c) places.emplace_back(graph(b, c).columns.size());
  std::vector<MergedEntry> row;
  for (int b = 0; b < n_blocks(); ++b)
    for (int a = 0; a < mesh_of(b).n_owned; ++a) {
      find_row(graph, numbers, n_blocks(), b, a, row);
      const std::size_t start = row_start(numbers.first(b, a)),
                        length = row_start(numbers.first(b, a) + 1) - start;
      rows_[b].start.push_back(start);
      rows_[b].length.push_back(length);
      std::size_t place = 0;
      for (const MergedEntry& entry : row) {
        places[b * n_blocks() + entry.block][entry.k] = static_cast<std::int16_t>(place);
        for (int j = 0; j < layout.components(entry.block); ++j, ++place)
          for (int i = 0; i < layout.components(b); ++i)
            columns(start + i * length + place) = entry.column + j;
      }
    }
  store_merged(algebra::matrix_on(
      algebra::static_graph(numbers.rows(), numbers.map(), row_start, columns, numbers.rows())));
  columns_ = merged()->getLocalMatrixHost().graph.entries.data();
  for (int a = 0; a < mesh_->n_nodes(); ++a) columns_of_vectors_.push_back(numbers.first(0, a));
  find_element_places(graphs, places);
}

void BlockOperator::find_element_places(const Graphs& graphs,
                                        const std::vector<std::vector<std::int16_t>>& places) {
  int offset = 0;
  for (int b = 0; b < n_blocks(); ++b) {
    offsets_.push_back(offset);
    offset += (*space())[b].components;
  }
  const auto places_of = [&](std::size_t e, int row, int column) {
    const NodeGraph& graph = graphs(*space(), row, column);
    ElementPlaces all;
    all.fill(-1);
    for (int a = 0; a < 4; ++a) {
      const int node = mesh_of(row).tets[e][a];
      if (node >= mesh_of(row).n_owned) continue;
      for (int b = 0; b < 4; ++b)
        all[4 * a + b] =
            places[row * n_blocks() + column][graph.row_start[node] + graph.position[e][4 * a + b]];
    }
    return all;
  };
  const auto is_regular = [&](std::size_t e) {
    for (int row = 0; row < n_blocks(); ++row)
      for (int column = 0; column < n_blocks(); ++column) {
        const ElementPlaces own = places_of(e, row, column);
        for (int k = 0; k < 16; ++k)
          if (own[k] >= 0 && own[k] != places_[e][k] + offsets_[column]) return false;
      }
    return true;
  };
  if (split_ != nullptr) own_places_.assign(mesh_->tets.size(), -1);
  places_.reserve(mesh_->tets.size());
  for (std::size_t e = 0; e < mesh_->tets.size(); ++e) {
    places_.push_back(places_of(e, 0, 0));
    if (split_ == nullptr || is_regular(e)) continue;
    own_places_[e] = static_cast<int>(more_places_.size());
    for (int row = 0; row < n_blocks(); ++row)
      for (int column = 0; column < n_blocks(); ++column)
        more_places_.push_back(places_of(e, row, column));
  }
  more_places_.shrink_to_fit();
}

int BlockOperator::place(int row, int column) const {
  const int* const first = columns_ + rows_[0].start[row];
  const int* const last = first + rows_[0].length[row];
  return static_cast<int>(std::lower_bound(first, last, columns_of_vectors_[column]) - first);
}

double* BlockOperator::begin_assembly() {
  merged()->resumeFill();
  const auto values = merged()->getLocalMatrixHost().values;
  std::fill(values.data(), values.data() + values.extent(0), 0.0);
  return values.data();
}

void BlockOperator::end_assembly() {
  merged()->fillComplete(merged()->getDomainMap(), merged()->getRangeMap());
  values_changed();
}

const FieldMesh& BlockOperator::mesh_of(int block) const {
  return split_ != nullptr && (*space())[block].components == 1 ? *split_ : *mesh_;
}

}  // namespace tunica::fields
