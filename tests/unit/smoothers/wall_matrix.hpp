#pragma once
#include "tunica/algebra/merged_matrix.hpp"
#include "unit/linear/mixed_operator.hpp"

namespace tunica::test {

/// The Jacobian of a deformed wall as one matrix, on all ranks or on each alone.
struct WallMatrix {
  explicit WallMatrix(const CommPtr& comm = world())
      : tube(comm), jacobian(tube), merged(jacobian.K) {
    jacobian.set(0.005);
  }

  Teuchos::RCP<CrsMatrix> K() const { return merged.matrix(); }
  const fields::FieldMesh& mesh() const { return tube.wall; }

  /// Numbers without pattern, the same for a vertex wherever it is.
  Vector scattered(int seed) const {
    Vector x(K()->getRowMap());
    merged.merge(test::scattered(mesh(), seed), x);
    return x;
  }

  SmallTube tube;
  WallJacobian jacobian;
  algebra::MergedMatrix merged;
};

}  // namespace tunica::test
