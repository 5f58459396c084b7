#pragma once
#include <array>
#include <cstdint>
#include <memory>

#include "tunica/algebra/block_matrix.hpp"
#include "tunica/base/types.hpp"
#include "tunica/fields/split_mesh.hpp"

namespace tunica::fields {

/// Which nodes each owned node couples to, and where each element finds its pairs: row a of
/// the node graph holds the local nodes columns[row_start[a] .. row_start[a+1]), ascending.
struct NodeGraph {
  std::vector<std::size_t> row_start;  ///< size n_owned + 1
  std::vector<int> columns;            ///< local nodes
  /// Per tet: offset of column b in row a at 4a + b; -1 where node a is not owned. The longest part
  /// of the graph: 16 bits are enough for the neighbours of a node.
  std::vector<std::array<std::int16_t, 16>> position;
};
NodeGraph make_node_graph(const FieldMesh& mesh);
/// Rows and columns on different nodes of the same tetrahedra.
NodeGraph make_node_graph(const FieldMesh& rows, const FieldMesh& columns);

/// A kind of unknown at each node of a field.
struct NodalBlock {
  std::string name;
  int components;  ///< 1 or 3
};
using NodalBlocks = std::vector<NodalBlock>;
/// What a mixed formulation has, whatever it calls them.
inline const NodalBlocks mixed_blocks{{"vector", 3}, {"scalar", 1}};

/// Their space, without nodes for multigrid.
algebra::BlockSpacePtr nodal_space(const FieldMesh& mesh, const NodalBlocks& blocks = mixed_blocks);

/// Zero unknowns of a field.
inline algebra::BlockVector zero_vector(const FieldMesh& mesh) {
  return algebra::BlockVector(nodal_space(mesh));
}

/// What the regions of a mesh with several fields are parts of.
struct MeshParts {
  std::vector<std::string> names;  ///< the last is that of the nodes between other parts
  std::vector<int> of_region;      ///< index into names
};

/// The Jacobian of a field: matrices between all its blocks on static graphs, one for all that
/// stand on the same nodes. Values are written in place by assembly/.
class BlockOperator : public algebra::BlockMatrix {
public:
  /// split: carries the scalars where it is not null. The meshes must outlive the object.
  explicit BlockOperator(const FieldMesh& mesh, const NodalBlocks& blocks = mixed_blocks,
                         const SplitMesh* split = nullptr, const MeshParts& parts = {});

  const FieldMesh& mesh() const { return *mesh_; }
  /// Null where the scalars stand on the nodes of the mesh.
  const SplitMesh* split() const { return split_; }
  const FieldMesh& mesh_of(int block) const;
  /// For a matrix that nobody assembles element by element: gives back the room of the graphs.
  void forget_graphs() { graphs_.fill(nullptr); }
  /// That of the matrix between two blocks.
  const NodeGraph& graph(int row = 0, int column = 0) const;

private:
  const FieldMesh* mesh_;
  const SplitMesh* split_;
  /// By whether rows and columns are on the split mesh; the same without one.
  std::array<std::shared_ptr<const NodeGraph>, 4> graphs_;
};

/// A matrix with rows dofs_row*node + i and columns dofs_column*node + j on the node graph,
/// rows sorted by local column, all values zero.
Teuchos::RCP<CrsMatrix> make_matrix(const NodeGraph& graph, const FieldMesh& mesh, int dofs_row,
                                    int dofs_column);

}  // namespace tunica::fields
