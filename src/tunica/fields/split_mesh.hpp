#pragma once
#include <memory>

#include "tunica/fields/field_mesh.hpp"

namespace tunica::fields {

/// A field's mesh cut apart where its parts meet, for values that jump there: a node for each
/// vertex and part. The tetrahedra, their order and their owners are those of the field's mesh, and
/// so are its nodes, which stand for the first part at their vertex and keep their numbers. Behind
/// them, and with numbers behind all of theirs, come those of the other parts.
struct SplitMesh : FieldMesh {
  std::vector<int> node;  ///< per local node: that of the field's mesh
  std::vector<int> copy;  ///< per local node: how many parts come before its own at the vertex
  int n_copies = 1;       ///< of nodes at a vertex, the most there are
};

/// parts: of each region of the mesh, from 0; what it says of regions outside the field does not
/// count. Vertex numbers of further copies lie beyond those of the mesh; none is there twice. Null
/// where no vertex lies between parts. Collective.
std::unique_ptr<SplitMesh> split_mesh(const FieldMesh& mesh, const std::vector<int>& parts);

/// The mesh whose nodes carry the scalars of a field: split, where it is not null.
inline const FieldMesh& scalar_mesh(const FieldMesh& mesh, const SplitMesh* split) {
  return split != nullptr ? *split : mesh;
}
/// The node of the field's mesh where one of scalar_mesh() stands.
inline int host_of(int node, const SplitMesh* split) {
  return split != nullptr ? split->node[node] : node;
}

}  // namespace tunica::fields
