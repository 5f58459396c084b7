#pragma once
#include <vector>

#include "multigrid/mixed_numbering.hpp"

namespace tunica::multigrid {

/// The blocks off the velocity's diagonal of a mixed matrix: copies, in the numbers of the blocks.
struct MixedBlocks {
  Teuchos::RCP<CrsMatrix> B1T, B2, mC;        ///< mC holds −C
  Teuchos::RCP<Vector> diagonal;              ///< of A
  std::vector<int> vector_rows, scalar_rows;  ///< local row of K of each row of the blocks
};

/// Collective.
MixedBlocks mixed_blocks(const CrsMatrix& K, const MixedNumbering& numbering);

/// Takes the two parts out of a vector of all unknowns, u and p on the rows of the blocks.
void split(const MixedBlocks& blocks, const MultiVector& all, Vector& u, Vector& p);
/// all += factor (u, p).
void add(const MixedBlocks& blocks, Scalar factor, const Vector& u, const Vector& p,
         MultiVector& all);

}  // namespace tunica::multigrid
