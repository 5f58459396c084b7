#pragma once
#include <optional>
#include <string>

#include "tunica/fields/field_mesh.hpp"

namespace tunica::problems {

/// The most inverted element over all ranks, where there is one. smallest and element are the
/// calling rank's smallest determinant (or volume) and its local element (-1: none).
/// measure: what smallest is, "det F". Collective; the same on all ranks.
std::optional<std::string> describe_inversion(const fields::FieldMesh& mesh, double smallest,
                                              int element, const std::string& measure);

}  // namespace tunica::problems
