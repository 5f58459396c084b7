#pragma once
#include <vector>

#include "tunica/fields/field_mesh.hpp"

namespace tunica::discretisation {

/// One flag per local element: true where one of its vertices belongs to an element of another
/// material too. material: one number per region of the mesh. Collective.
std::vector<char> at_layer_boundary(const fields::FieldMesh& mesh,
                                    const std::vector<int>& material);

}  // namespace tunica::discretisation
