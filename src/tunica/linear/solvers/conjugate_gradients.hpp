#pragma once
#include <vector>

#include "tunica/base/types.hpp"

namespace tunica::linear {

/// Conjugate gradients for several right sides at once, which share their messages:
///
///   z = M r,  p = z + (rᵀz / r₋ᵀz₋) p₋,  w = K p,  α = rᵀz / pᵀw,  x ← x + α p,  r ← r − α w
///
///   r  residual   z  the preconditioned one   p  search direction   M  preconditioner
///
/// with two reductions an iteration, for |r| behind it is foretold by
///
///   |r − α w|² = |r|² − 2 α rᵀw + α² |w|².
///
/// K and M: symmetric positive definite. goals: |r| that each column is to reach. R: B − K X on
/// entry, on return what the recurrence says of it. Returns the iterations. Ends early where K or
/// M show that they are not positive, or what is no number. Throws StopRequest on all ranks where a
/// signal wants to end the program. Collective.
///
/// Source: Hestenes, Stiefel 1952.
int conjugate_gradients(const Operator& K, const Operator& M, const std::vector<double>& goals,
                        int max_iterations, MultiVector& R, MultiVector& X);

}  // namespace tunica::linear
