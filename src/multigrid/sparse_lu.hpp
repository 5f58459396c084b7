#pragma once
#include <Amesos2_Solver_decl.hpp>

#include "base/types.hpp"

namespace tunica::multigrid {

using SparseLu = Amesos2::Solver<CrsMatrix, MultiVector>;

/// KLU2 for the matrix, whose numbers may have gaps, with nothing done yet. Collective.
Teuchos::RCP<SparseLu> make_sparse_lu(const Teuchos::RCP<const CrsMatrix>& A);

}  // namespace tunica::multigrid
