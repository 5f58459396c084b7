#pragma once
#include <string>
#include <vector>

#include "tunica/fields/field_mesh.hpp"
#include "tunica/materials/frame.hpp"
#include "tunica/params/table.hpp"

namespace tunica::problems {

/// The keys of "Fibre Frame": where the directions of the wall's fibres come from.
///   tube      from a straight axis
///   laplace   from two harmonic functions, one through the wall, one along it
///   mesh      from vectors that the mesh file gives on its elements
params::Table fibre_frame_table();

/// The surfaces that a resolved "Fibre Frame" list names.
std::vector<std::string> frame_surfaces(const Teuchos::ParameterList& list);

/// One frame per local element of the wall, that of its centroid. list: the resolved "Fibre
/// Frame" list, of another kind than "none". Throws Error on all ranks alike where a direction
/// does not exist. Collective.
std::vector<materials::Frame> fibre_frames(const Teuchos::ParameterList& list,
                                           const fields::FieldMesh& mesh);

}  // namespace tunica::problems
