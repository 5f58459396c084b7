#pragma once
#include <string>

#include "tunica/algebra/block_matrix.hpp"
#include "tunica/fields/field_mesh.hpp"
#include "tunica/linear/named_operators.hpp"
#include "tunica/systems/read_system.hpp"

namespace tunica::compare {

/// One linear system K x = b, and where in a run it stands. The objects referred to belong to the
/// problem and change with the next Newton step.
struct LinearSystem {
  std::string field;  ///< "fluid", "wall", or "system" for one of another program
  int step = 0;       ///< all three counted from 1; 0 for one of another program
  int coupling_iteration = 0;
  int newton_step = 0;
  const algebra::BlockMatrix* K = nullptr;
  const algebra::BlockVector* b = nullptr;
  const linear::NamedOperators* operators = nullptr;
  const fields::FieldMesh* mesh = nullptr;  ///< none for one of another program
  /// Of another program, K and b are those of this; null for one of a run.
  const systems::System* of_files = nullptr;

  /// "fluid-newton-1", "system"
  std::string name() const {
    return newton_step == 0 ? field : field + "-newton-" + std::to_string(newton_step);
  }
};

}  // namespace tunica::compare
