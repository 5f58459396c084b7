#pragma once
#include <string>

#include "fields/block_operator.hpp"
#include "linear/named_operators.hpp"

namespace tunica::app {

/// One linear system of a run, K x = b, and where in the run it stands. The objects referred to
/// belong to the problem and change with the next Newton step.
struct LinearSystem {
  std::string field;  ///< "fluid" or "wall"
  int step;           ///< all three counted from 1
  int coupling_iteration;
  int newton_step;
  const fields::BlockOperator* K;
  const fields::BlockVector* b;
  const linear::NamedOperators* operators;

  /// "fluid-newton-1"
  std::string name() const { return field + "-newton-" + std::to_string(newton_step); }
};

}  // namespace tunica::app
