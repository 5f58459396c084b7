#pragma once
#include "tunica/algebra/concatenation.hpp"
#include "tunica/linear/preconditioned_system.hpp"

namespace tunica::linear {

/// The blocks behind each other, and a preconditioner of them: an operator on such vectors whose
/// refresh() sets it up for the present values.
template <class Preconditioner>
class ConcatenatedSystem : public PreconditionedSystem {
public:
  /// K must outlive the object.
  ConcatenatedSystem(const algebra::BlockMatrix& K,
                     const Teuchos::RCP<Preconditioner>& preconditioner)
      : blocks_(K.space()), matrix_(Teuchos::rcp(new algebra::ConcatenatedOperator(blocks_, K))),
        preconditioner_(preconditioner) {}

  Teuchos::RCP<const Map> map() const override { return blocks_.map(); }
  Teuchos::RCP<const Operator> matrix() const override { return matrix_; }
  Teuchos::RCP<const Operator> preconditioner() const override { return preconditioner_; }
  void refresh_matrix() override {}  // the operator reads the blocks, which follow
  void refresh_preconditioner() override { preconditioner_->refresh(); }
  void gather(const algebra::BlockVector& x, MultiVector& all) const override {
    blocks_.gather(x, all);
  }
  void scatter(const MultiVector& all, algebra::BlockVector& x) const override {
    blocks_.scatter(all, x);
  }

private:
  algebra::Concatenation blocks_;
  Teuchos::RCP<algebra::ConcatenatedOperator> matrix_;
  Teuchos::RCP<Preconditioner> preconditioner_;
};

}  // namespace tunica::linear
