#pragma once
#include <Thyra_TpetraThyraWrappers.hpp>

#include "tunica/base/types.hpp"

namespace tunica::linear {

/// A matrix as Thyra and Teko see it; the storage is shared.
inline Teuchos::RCP<const Thyra::LinearOpBase<Scalar>> thyra_operator(
    const Teuchos::RCP<const CrsMatrix>& matrix) {
  const Teuchos::RCP<const Operator> op = matrix;
  return Thyra::createConstLinearOp<Scalar, LocalOrdinal, GlobalOrdinal, Node>(op);
}

/// The matrix behind such an operator. Throws Teuchos::m_bad_cast where there is none.
inline Teuchos::RCP<const CrsMatrix> matrix_of(
    const Teuchos::RCP<const Thyra::LinearOpBase<Scalar>>& op) {
  using Extract = Thyra::TpetraOperatorVectorExtraction<Scalar, LocalOrdinal, GlobalOrdinal, Node>;
  return Teuchos::rcp_dynamic_cast<const CrsMatrix>(Extract::getConstTpetraOperator(op), true);
}

}  // namespace tunica::linear
