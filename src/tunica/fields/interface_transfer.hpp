#pragma once
#include "tunica/fields/field_mesh.hpp"

namespace tunica::fields {

/// Values at the owned interface nodes, three per node.
using InterfaceVector = std::vector<double>;

/// The nodes that fluid and wall share, matched by their vertex of the mesh, and the way of values
/// between the two fields and the interface. Both sides of a vertex live on the same rank, so that
/// transfer needs no communication.
class InterfaceTransfer {
public:
  InterfaceTransfer(const FieldMesh& fluid, const FieldMesh& wall,
                    const std::vector<int>& shared_surfaces);

  int n_owned() const { return static_cast<int>(fluid_nodes.size()); }
  long long n_total() const { return n_total_; }

  /// Values of the interface on the owned nodes of a field, zero elsewhere.
  std::vector<Vec3> to_fluid(const InterfaceVector& values) const;
  std::vector<Vec3> to_wall(const InterfaceVector& values) const;
  /// Values of the interface out of those on the owned nodes of a field.
  InterfaceVector from_fluid(const std::vector<Vec3>& values) const;
  InterfaceVector from_wall(const std::vector<Vec3>& values) const;

  std::vector<int> surfaces;     ///< indices into FieldMesh::surfaces
  std::vector<int> fluid_nodes;  ///< local nodes owned by this rank
  std::vector<int> wall_nodes;   ///< in the same order

private:
  int n_fluid_, n_wall_;  ///< owned nodes
  long long n_total_ = 0;
};

}  // namespace tunica::fields
