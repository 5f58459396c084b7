#pragma once
#include <vector>

#include "tunica/base/types.hpp"

namespace tunica::algebra {

/// A matrix as an operator that reads column numbers once for rows that follow each other and have
/// the same columns, those of a node: 9 bytes for an entry in place of 12.
class GroupedMatrix final : public Operator {
public:
  /// A must keep its graph.
  explicit GroupedMatrix(const Teuchos::RCP<const CrsMatrix>& A);

  void apply(const MultiVector& X, MultiVector& Y, Teuchos::ETransp mode = Teuchos::NO_TRANS,
             Scalar alpha = 1.0, Scalar beta = 0.0) const override;
  Teuchos::RCP<const Map> getDomainMap() const override { return A_->getDomainMap(); }
  Teuchos::RCP<const Map> getRangeMap() const override { return A_->getRangeMap(); }

private:
  Teuchos::RCP<const CrsMatrix> A_;
  std::vector<int> start_;  ///< the first row of each group, and the number of rows
};

}  // namespace tunica::algebra
