#pragma once
#include <string>

#include "tunica/assembly/element_geometry.hpp"
#include "tunica/base/outcome.hpp"
#include "tunica/fields/field_mesh.hpp"

namespace tunica::discretisation {

/// An element as messages name it, with its region and its middle.
struct NamedElement {
  std::string name;
  double value;
};
/// That of the least value over all ranks, or of one that is not a number. value and element are
/// the calling rank's (-1: none). Collective; the same on all ranks.
NamedElement least_element(const fields::FieldMesh& mesh, double value, int element);

/// Fails where an element is inverted, and names the worst one over all ranks. smallest and element
/// are the calling rank's smallest determinant (or volume) and its local element (-1: none).
/// measure: what smallest is, "det F". Collective; the same on all ranks.
Outcome check_inversion(const fields::FieldMesh& mesh, double smallest, int element,
                        const std::string& measure);

/// Checks the volumes of elements [mm³], one for each local tetrahedron.
Outcome check_volumes(const fields::FieldMesh& mesh, const assembly::ElementGeometry& geometry);

}  // namespace tunica::discretisation
