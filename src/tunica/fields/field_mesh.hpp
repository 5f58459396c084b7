#pragma once
#include <algorithm>
#include <string>
#include <utility>
#include <vector>

#include "tunica/base/tensor.hpp"
#include "tunica/base/types.hpp"
#include "tunica/mesh/mesh.hpp"

namespace tunica::mesh {
struct Share;
}

namespace tunica::fields {

/// A boundary triangle of a field, counter-clockwise seen from outside the field.
struct Face {
  std::array<int, 3> nodes;  ///< local nodes
  int surface;               ///< index into FieldMesh::surfaces
  bool is_owned;             ///< true on exactly one rank: sums over the surface use it there
  int tet;                   ///< the local tetrahedron that it is a side of
};

/// The surfaces that each node lies on: of most nodes none, of few more than one, however many the
/// mesh has. The pairs of a node and a surface are numbered, node by node.
class NodeSurfaces {
public:
  NodeSurfaces() = default;
  /// pairs: local node and surface, in any order and with repetitions.
  NodeSurfaces(int n_nodes, std::vector<std::pair<int, int>> pairs);

  int size() const { return static_cast<int>(surface_.size()); }
  /// The pairs of a node, and the surface of a pair.
  int begin(int node) const { return first_[node]; }
  int end(int node) const { return first_[node + 1]; }
  int surface(int pair) const { return surface_[pair]; }
  /// The pair of node and surface; -1 where the node does not lie on it.
  int find(int node, int surface) const {
    for (int k = begin(node); k < end(node); ++k)
      if (surface_[k] == surface) return k;
    return -1;
  }

private:
  std::vector<int> first_;    ///< per node, and the total at the end: its place in surface_
  std::vector<int> surface_;  ///< those of a node ascend
};

/// One field's share of the mesh on one rank: the owned nodes, every tetrahedron and boundary
/// triangle that touches one of them or is counted by the rank, and the ghost nodes these need.
/// Owned rows can thus be assembled without communication.
struct FieldMesh {
  CommPtr comm;
  std::vector<std::string> regions;   ///< of the whole mesh
  std::vector<std::string> surfaces;  ///< of the whole mesh

  int n_owned = 0;             ///< owned nodes stand first in all node arrays
  std::vector<Vec3> x;         ///< reference positions [mm]
  std::vector<int> vertex;     ///< vertex number in the mesh file
  NodeSurfaces node_surfaces;  ///< of owned and ghost nodes

  std::vector<std::array<int, 4>> tets;
  std::vector<int> region;                ///< per tet: index into regions
  std::vector<GlobalOrdinal> tet_number;  ///< per tet: its place among those of the mesh, from 1
  std::vector<char> is_owned;             ///< per tet: true on exactly one rank
  std::vector<mesh::TetVectors> tet_vectors;  ///< those of the mesh, per tet of this rank
  std::vector<Face> faces;

  Teuchos::RCP<const Map> node_map;     ///< owned nodes, contiguous on each rank
  Teuchos::RCP<const Map> ghosted_map;  ///< owned nodes, then ghosts
  Teuchos::RCP<const Map> vector_map;   ///< 3*node + i of the owned nodes
  Teuchos::RCP<const Map> ghosted_vector_map;
  Teuchos::RCP<const Import> import;  ///< node_map -> ghosted_map
  Teuchos::RCP<const Import> vector_import;

  /// The maps of one or three unknowns per node.
  const Teuchos::RCP<const Map>& owned_map(int components) const {
    return components == 1 ? node_map : vector_map;
  }
  const Teuchos::RCP<const Map>& map_with_ghosts(int components) const {
    return components == 1 ? ghosted_map : ghosted_vector_map;
  }
  /// Index into surfaces; -1 for an unknown name.
  int surface_index(const std::string& name) const;
  int n_nodes() const { return static_cast<int>(x.size()); }
  bool is_on(int node, int surface) const { return node_surfaces.find(node, surface) >= 0; }
  bool is_on_boundary(int node) const {
    return node_surfaces.begin(node) != node_surfaces.end(node);
  }
  bool is_on_any(int node, const std::vector<int>& indices) const {
    return std::any_of(indices.begin(), indices.end(), [&](int s) { return is_on(node, s); });
  }
};

/// The share of the calling rank in the field that fills the given regions (indices into
/// mesh.regions). Collective.
FieldMesh make_field_mesh(const mesh::Share& share, const std::vector<int>& regions);

/// Sets the maps of a mesh whose owned and ghost nodes have these numbers. Collective.
void set_maps(const std::vector<GlobalOrdinal>& numbers, FieldMesh& mesh);

/// The surfaces that bound the field, ascending. Collective.
std::vector<int> bounding_surfaces(const FieldMesh& mesh);

/// Nodal values on owned nodes.
std::vector<Vec3> owned_vectors(const FieldMesh& mesh, const Vector& v);

/// Nodal values on owned and ghost nodes. Collective.
std::vector<Vec3> ghosted_vectors(const FieldMesh& mesh, const Vector& v);
/// From values of which those of owned nodes count.
std::vector<Vec3> ghosted_vectors(const FieldMesh& mesh, const std::vector<Vec3>& values);
std::vector<double> ghosted_scalars(const FieldMesh& mesh, const Vector& v);

/// Copies the owned part of nodal values into a distributed vector.
void store(const std::vector<Vec3>& values, const FieldMesh& mesh, Vector& v);

}  // namespace tunica::fields
