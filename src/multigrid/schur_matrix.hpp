#pragma once
#include "base/types.hpp"

namespace tunica::multigrid {

/// C + B2 D⁻¹ B1ᵀ for the blocks of K = [A B1ᵀ; B2 −C]; mC holds −C, D is a diagonal. Collective.
Teuchos::RCP<CrsMatrix> schur_matrix(const CrsMatrix& B1T, const CrsMatrix& B2, const CrsMatrix& mC,
                                     const Vector& inverse_D);

}  // namespace tunica::multigrid
