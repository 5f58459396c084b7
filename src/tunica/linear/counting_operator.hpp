#pragma once
#include "tunica/base/types.hpp"

namespace tunica::linear {

/// An operator that counts its applications.
class CountingOperator : public Operator {
public:
  explicit CountingOperator(const Teuchos::RCP<const Operator>& inner) : inner_(inner) {}

  void apply(const MultiVector& X, MultiVector& Y, Teuchos::ETransp mode = Teuchos::NO_TRANS,
             Scalar alpha = 1.0, Scalar beta = 0.0) const override {
    ++count_;
    inner_->apply(X, Y, mode, alpha, beta);
  }
  Teuchos::RCP<const Map> getDomainMap() const override { return inner_->getDomainMap(); }
  Teuchos::RCP<const Map> getRangeMap() const override { return inner_->getRangeMap(); }

  int count() const { return count_; }

private:
  Teuchos::RCP<const Operator> inner_;
  mutable int count_ = 0;
};

}  // namespace tunica::linear
