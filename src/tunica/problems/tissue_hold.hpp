#pragma once
#include <vector>

#include "tunica/boundary/surface_terms.hpp"

namespace tunica::problems {

/// What the springs of the tissue around a wall do in its mesh, in the geometry of an image: their
/// pressure on faces, or its length where they act in all directions.
struct TissueHold {
  double mean = 0.0;  ///< root mean square over the surfaces with springs [kPa]
  double most = 0.0;  ///< the largest [kPa]
  Vec3 at{};          ///< where that is [mm]
};

/// conditions: of the wall, resolved; offset: stretch of the springs, on owned and ghost nodes
/// [mm]. Collective.
TissueHold tissue_hold(const std::vector<boundary::Condition>& conditions,
                       const fields::FieldMesh& mesh, const std::vector<Vec3>& offset);

bool has_springs(const std::vector<boundary::Condition>& conditions);

}  // namespace tunica::problems
