#pragma once
#include <array>
#include <cstdint>
#include <memory>

#include "tunica/algebra/block_matrix.hpp"
#include "tunica/base/types.hpp"
#include "tunica/fields/split_mesh.hpp"

namespace tunica::fields {

/// Coupling of owned nodes, and the positions of each element's pairs: row a of the node graph
/// holds the local nodes columns[row_start[a] .. row_start[a+1]), ascending.
struct NodeGraph {
  std::vector<std::size_t> row_start;  ///< size n_owned + 1
  std::vector<int> columns;            ///< local nodes
  /// Per tet: offset of column b in row a at 4a + b; -1 where node a is not owned. The longest part
  /// of the graph: 16 bits are enough for the neighbours of a node.
  std::vector<std::array<std::int16_t, 16>> position;

  std::size_t length(int node) const { return row_start[node + 1] - row_start[node]; }
};
NodeGraph make_node_graph(const FieldMesh& mesh);
/// Rows and columns on different nodes of the same tetrahedra.
NodeGraph make_node_graph(const FieldMesh& row_mesh, const FieldMesh& column_mesh);

/// A kind of unknown at each node of a field.
struct NodalBlock {
  std::string name;
  int components;  ///< 1 or 3
};
using NodalBlocks = std::vector<NodalBlock>;
/// The blocks of a mixed formulation, under generic names.
inline const NodalBlocks mixed_blocks{{"vector", 3}, {"scalar", 1}};

/// Their space, without nodes for multigrid. split: carries the scalars where it is not null.
algebra::BlockSpacePtr nodal_space(const FieldMesh& mesh, const NodalBlocks& blocks = mixed_blocks,
                                   const SplitMesh* split = nullptr);

/// Zero unknowns of a field.
inline algebra::BlockVector zero_vector(const FieldMesh& mesh) {
  return algebra::BlockVector(nodal_space(mesh));
}

/// Parts of a mesh with several fields, by its regions.
struct MeshParts {
  std::vector<std::string> names;  ///< the last is that of the nodes between other parts
  std::vector<int> of_region;      ///< index into names
  std::vector<char> is_solid{};    ///< by region: its vectors move a solid; empty: none does
};

/// The Jacobian of a field or of several: all unknowns of a node side by side in one matrix on a
/// static graph, whose values are written in place by assembly/.
class BlockOperator : public algebra::BlockMatrix {
public:
  /// split: carries the scalars where it is not null. The meshes must outlive the object. Throws
  /// Error on all ranks for a vertex with more than 8,000 neighbours. Collective.
  explicit BlockOperator(const FieldMesh& mesh, const NodalBlocks& blocks = mixed_blocks,
                         const SplitMesh* split = nullptr, const MeshParts& parts = {});

  const FieldMesh& mesh() const { return *mesh_; }
  /// Null where the scalars stand on the nodes of the mesh.
  const SplitMesh* split() const { return split_; }
  const FieldMesh& mesh_of(int block) const;

  /// The rows of a block among the values of merged(): that of component i at an owned node begins
  /// at start[node] + i length[node].
  struct Rows {
    std::vector<std::size_t> start, length;
  };
  const Rows& rows(int block) const { return rows_[block]; }
  /// Where, in the rows that one block has at the nodes of an element, component 0 of another
  /// stands.
  struct Places {
    const std::int16_t* place;
    int offset;
    /// Nodes a and b of its four; a is owned.
    int operator()(int a, int b) const { return place[4 * a + b] + offset; }
  };
  Places places(std::size_t tet, int row, int column) const {
    const int own = own_places_.empty() ? -1 : own_places_[tet];
    if (own < 0) return {places_[tet].data(), offsets_[column]};
    return {more_places_[static_cast<std::size_t>(own) + row * n_blocks() + column].data(), 0};
  }
  /// Positions at which the unknowns of an element's nodes begin, if they are side by side in every
  /// row; otherwise null. For a vector and a scalar only.
  const std::int16_t* places_side_by_side(std::size_t tet) const {
    if (!own_places_.empty() && own_places_[tet] >= 0) return nullptr;
    return places_[tet].data();
  }
  /// The position for two local nodes of the first block that share an element.
  int place(int row, int column) const;

  /// Opens merged() with zeros for writing; its values. Collective, as end_assembly() is.
  double* begin_assembly();
  void end_assembly();

private:
  using ElementPlaces = std::array<std::int16_t, 16>;
  struct Graphs;

  void make_merged(const Graphs& graphs);
  void find_element_places(const Graphs& graphs,
                           const std::vector<std::vector<std::int16_t>>& places);

  const FieldMesh* mesh_;
  const SplitMesh* split_;
  std::vector<Rows> rows_;               ///< per block
  const int* columns_ = nullptr;         ///< local, per value of merged()
  std::vector<int> columns_of_vectors_;  ///< local column of component 0, per local node
  /// Per tetrahedron, those between vectors: all blocks of its nodes stand side by side, so that
  /// other columns follow with these offsets and other rows look the same.
  std::vector<ElementPlaces> places_;
  std::vector<int> offsets_;
  /// Position of a tetrahedron's own tables for all pairs of blocks, where scalars jump; -1: none.
  std::vector<int> own_places_;
  std::vector<ElementPlaces> more_places_;
};

/// Rows dofs_row*node + i and columns dofs_column*node + j on the node graph, rows sorted by local
/// column.
Teuchos::RCP<CrsGraph> make_graph(const NodeGraph& graph, const FieldMesh& mesh, int dofs_row = 1,
                                  int dofs_column = 1);
/// A matrix with these entries, all of them zero.
Teuchos::RCP<CrsMatrix> make_matrix(const NodeGraph& graph, const FieldMesh& mesh, int dofs_row,
                                    int dofs_column);

}  // namespace tunica::fields
