#pragma once
#include <Thyra_LinearOpBase.hpp>
#include <utility>
#include <vector>

#include "tunica/base/types.hpp"

namespace tunica::linear {

using InverseOp = Teuchos::RCP<const Thyra::LinearOpBase<Scalar>>;

/// x ↦ Σ cᵢ Aᵢ x over at least one term {cᵢ, Aᵢ}. Unlike Thyra's sums and multiples it asks no
/// term to scale its result or to add it to what is there: MueLu's operators of Trilinos 13.2
/// silently do neither, and Ifpack2's relaxations refuse to add.
InverseOp inverse_sum(const std::vector<std::pair<Scalar, InverseOp>>& terms);

}  // namespace tunica::linear
