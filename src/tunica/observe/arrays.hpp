#pragma once
#include "tunica/fields/field_mesh.hpp"
#include "tunica/output/field_writer.hpp"

namespace tunica::observe {

/// The share of a field's mesh that this rank writes. Of the wall that is a mesh in which vertices
/// between layers are there once for each: values that jump can be seen to.
output::Grid grid_of(const fields::FieldMesh& mesh, const std::string& name);

/// Of the first `count` nodes.
output::Array vector_array(const std::string& name, const std::vector<Vec3>& values, int count);
/// Of the nodes of a distributed vector with so many components at each.
output::Array dof_array(const std::string& name, int components, const Vector& v);

}  // namespace tunica::observe
