#pragma once
#include "tunica/fields/field_mesh.hpp"

namespace tunica::fields {

/// The nodes that fluid and wall share, matched by their vertex of the mesh. Both sides of a
/// vertex live on the same rank, so that transfer needs no communication.
class Interface {
public:
  Interface(const FieldMesh& fluid, const FieldMesh& wall, const std::vector<int>& shared_surfaces);

  int n_owned() const { return static_cast<int>(fluid_nodes.size()); }
  long long n_total() const { return n_total_; }

  std::vector<int> surfaces;     ///< indices into FieldMesh::surfaces
  std::vector<int> fluid_nodes;  ///< local nodes owned by this rank
  std::vector<int> wall_nodes;   ///< in the same order

private:
  long long n_total_ = 0;
};

}  // namespace tunica::fields
