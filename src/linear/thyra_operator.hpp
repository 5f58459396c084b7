#pragma once
#include <Thyra_TpetraThyraWrappers.hpp>

#include "base/types.hpp"

namespace tunica::linear {

/// A matrix as Thyra and Teko see it; the storage is shared.
inline Teuchos::RCP<const Thyra::LinearOpBase<Scalar>> thyra_operator(
    const Teuchos::RCP<const CrsMatrix>& matrix) {
  const Teuchos::RCP<const Operator> op = matrix;
  return Thyra::createConstLinearOp<Scalar, LocalOrdinal, GlobalOrdinal, Node>(op);
}

}  // namespace tunica::linear
