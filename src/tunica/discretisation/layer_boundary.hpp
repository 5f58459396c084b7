#pragma once
#include <vector>

#include "tunica/discretisation/solid_options.hpp"
#include "tunica/fields/field_mesh.hpp"

namespace tunica::discretisation {

/// A number for each region of the mesh, the same for those of one material; -1 outside the wall.
std::vector<int> material_of_regions(const std::vector<Layer>& layers,
                                     const fields::FieldMesh& mesh);

/// One flag per local element: true where one of its vertices belongs to an element of another
/// material too. material: by material_of_regions(). Collective.
std::vector<char> at_layer_boundary(const fields::FieldMesh& mesh,
                                    const std::vector<int>& material);

}  // namespace tunica::discretisation
