#pragma once
#include "tunica/fields/field_mesh.hpp"
#include "tunica/output/field_writer.hpp"

namespace tunica::observe {

/// The share of a field's mesh that this rank writes. For the wall it is a mesh in which vertices
/// between layers exist once for each layer, so that jumping values are visible.
output::Grid grid_of(const fields::FieldMesh& mesh, const std::string& name);

/// Array of the first `count` nodes.
output::Array vector_array(const std::string& name, const std::vector<Vec3>& values, int count);
/// Array of the nodes of a distributed vector with this many components at each.
output::Array dof_array(const std::string& name, int components, const Vector& v);

}  // namespace tunica::observe
