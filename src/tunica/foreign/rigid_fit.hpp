#pragma once
#include "tunica/algebra/block_matrix.hpp"

namespace tunica::foreign {

/// Part of the rows of A on which small rotations about their own node do next to nothing, as in
/// the middle of a solid and on its free surfaces, if the places of the nodes are those of A. With
/// places in another order there are none. 0 where they are not known. Collective.
///
///   Σ_k |Σ_j A_rj (e_k × (x_j − x_r))_c(j)| ≤ 0.05 Σ_k Σ_j |A_rj (e_k × (x_j − x_r))_c(j)|
///
///   c(j)  component of unknown j, x_j place of its node, e_k the axes
double rigid_fit(const algebra::BlockMatrix& K);

}  // namespace tunica::foreign
