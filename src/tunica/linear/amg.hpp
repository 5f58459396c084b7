#pragma once
#include "tunica/base/types.hpp"

namespace tunica::linear {

/// A V-cycle of MueLu's smoothed aggregation for a scalar symmetric positive definite matrix,
/// itself symmetric. Throws SetupFailure. Collective.
Teuchos::RCP<Operator> make_amg(const Teuchos::RCP<CrsMatrix>& matrix);

}  // namespace tunica::linear
