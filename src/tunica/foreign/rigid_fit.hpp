#pragma once
#include "tunica/algebra/block_matrix.hpp"

namespace tunica::foreign {

/// How the places of the nodes fit A. Zeros where they are not known.
struct RigidFit {
  /// Part of the rows of A on which small rotations about their own node do next to nothing, as in
  /// the middle of a solid and on its free surfaces. With places in another order there are none.
  ///
  ///   Σ_k |Σ_j A_rj (e_k × (x_j − x_r))_c(j)| ≤ 0.05 Σ_k Σ_j |A_rj (e_k × (x_j − x_r))_c(j)|
  ///
  ///   c(j)  component of unknown j, x_j place of its node, e_k the axes
  double resting = 0.0;
  /// Part whose node is in the middle of its neighbours, as inside a regular mesh.
  ///
  ///   |Σ_j (x_j − x_r)|² ≤ 0.02² n Σ_j |x_j − x_r|²    over the n unknowns j of the row
  double centred = 0.0;
};

/// Collective.
RigidFit rigid_fit(const algebra::BlockMatrix& K);

}  // namespace tunica::foreign
