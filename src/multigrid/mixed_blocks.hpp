#pragma once
#include "base/types.hpp"

namespace tunica::multigrid {

/// The blocks off the velocity's diagonal of a matrix with the unknowns 4*node + i: copies, with
/// rows and columns 3*node + i for the velocity and node for the pressure.
struct MixedBlocks {
  Teuchos::RCP<CrsMatrix> B1T, B2, mC;  ///< mC holds −C
  Teuchos::RCP<Vector> diagonal;        ///< of A
};

/// Throws std::runtime_error on all ranks where the rows are not whole nodes of four unknowns.
/// Collective.
void check_mixed(const CrsMatrix& K);

/// Collective.
MixedBlocks mixed_blocks(const CrsMatrix& K);

/// Takes the two parts out of a vector of all unknowns, u and p on the rows of the blocks.
void split(const MultiVector& all, Vector& u, Vector& p);
/// all += factor (u, p).
void add(Scalar factor, const Vector& u, const Vector& p, MultiVector& all);

}  // namespace tunica::multigrid
