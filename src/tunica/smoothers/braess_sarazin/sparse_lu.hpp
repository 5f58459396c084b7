#pragma once
#include <Amesos2_Solver_decl.hpp>

#include "tunica/base/types.hpp"

namespace tunica::smoothers {

using SparseLu = Amesos2::Solver<CrsMatrix, MultiVector>;

/// KLU2 for the matrix, whose numbers may have gaps, with its rows ordered. Collective.
Teuchos::RCP<SparseLu> make_sparse_lu(const Teuchos::RCP<const CrsMatrix>& A);

/// Numeric factors for the present values of the same matrix. Throws std::exception that tells of
/// Amesos2's source lines where it is singular. Collective.
void refactor(SparseLu& lu, const Teuchos::RCP<const CrsMatrix>& A);

}  // namespace tunica::smoothers
