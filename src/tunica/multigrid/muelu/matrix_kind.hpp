#pragma once
#include <Teuchos_ParameterList.hpp>

namespace tunica::multigrid {

/// Throws tunica::Error for a factory in a MueLu list that wants the other kind of matrix: one
/// with the unknowns of a node side by side, or one of blocks.
void check_matrix_kind(const Teuchos::ParameterList& muelu, bool is_blocked);

/// Whether this is the list of Ifpack2's Schwarz smoother with one patch per pressure.
bool is_schwarz_of_pressures(const Teuchos::ParameterList& smoother);

}  // namespace tunica::multigrid
