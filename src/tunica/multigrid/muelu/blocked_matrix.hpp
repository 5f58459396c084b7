#pragma once
#include <MueLu_Level.hpp>
#include <Xpetra_BlockedCrsMatrix.hpp>

#include "tunica/algebra/dof_layout.hpp"
#include "tunica/multigrid/muelu/xpetra.hpp"

namespace tunica::multigrid {

using XBlockedMatrix = Xpetra::BlockedCrsMatrix<Scalar, LocalOrdinal, GlobalOrdinal, Node>;

/// A merged matrix as MueLu's matrix of blocks: first all components of the vector, then the
/// scalars. The blocks are copies that keep M's numbers. Zeros off the diagonal are left out, and
/// blocks of nothing else are null. Collective.
Teuchos::RCP<XBlockedMatrix> blocked(const CrsMatrix& M, const algebra::DofLayout& numbering);

/// One vector per component of a block: 1 in its rows, 0 elsewhere.
Teuchos::RCP<XMultiVector> constants(const XBlockedMatrix& A, int block, int components);

/// Gives a finest level the blocks of a merged matrix, and as near-null space of each the constants
/// of its components.
void set_blocks(MueLu::Level& finest, const CrsMatrix& A, const algebra::DofLayout& numbering);

}  // namespace tunica::multigrid
