#pragma once
#include <functional>
#include <memory>

#include "tunica/algebra/block_matrix.hpp"

namespace tunica::linear {

/// A + L on the vectors that a solver works on, L the part of a block matrix that has no entries.
class ActionSum final : public Operator {
public:
  /// Take blocks to the first column of a long vector, and back.
  using Gather = std::function<void(const algebra::BlockVector&, MultiVector&)>;
  using Scatter = std::function<void(const MultiVector&, algebra::BlockVector&)>;

  /// K has such a part.
  ActionSum(const Teuchos::RCP<const Operator>& A, const algebra::BlockMatrix& K, Gather gather,
            Scatter scatter);

  void apply(const MultiVector& X, MultiVector& Y, Teuchos::ETransp mode = Teuchos::NO_TRANS,
             Scalar alpha = 1.0, Scalar beta = 0.0) const override;
  Teuchos::RCP<const Map> getDomainMap() const override { return A_->getDomainMap(); }
  Teuchos::RCP<const Map> getRangeMap() const override { return A_->getRangeMap(); }

private:
  Teuchos::RCP<const Operator> A_;
  std::shared_ptr<const algebra::BlockAction> L_;
  Gather gather_;
  Scatter scatter_;
  algebra::BlockSpacePtr space_;
};

}  // namespace tunica::linear
