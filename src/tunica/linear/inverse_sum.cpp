#include "tunica/linear/inverse_sum.hpp"

#include <Thyra_LinearOpDefaultBase.hpp>
#include <Thyra_MultiVectorStdOps.hpp>
#include <Thyra_VectorSpaceBase.hpp>

namespace tunica::linear {

namespace {

using Space = Teuchos::RCP<const Thyra::VectorSpaceBase<Scalar>>;

class InverseSum final : public Thyra::LinearOpDefaultBase<Scalar> {
public:
  explicit InverseSum(const std::vector<std::pair<Scalar, InverseOp>>& terms) : terms_(terms) {}

  Space range() const override { return terms_.front().second->range(); }
  Space domain() const override { return terms_.front().second->domain(); }

protected:
  bool opSupportedImpl(Thyra::EOpTransp mode) const override { return mode == Thyra::NOTRANS; }

  // Y ← β Y + α Σ_i c_i A_i X, each term by itself and from zero
  void applyImpl(Thyra::EOpTransp mode, const Thyra::MultiVectorBase<Scalar>& X,
                 const Teuchos::Ptr<Thyra::MultiVectorBase<Scalar>>& Y, Scalar alpha,
                 Scalar beta) const override {
    // Y may hold anything then, NaN as well.
    if (beta == 0.0)
      Thyra::assign(Y, 0.0);
    else
      Thyra::scale(beta, Y);
    const auto term = Thyra::createMembers(range(), X.domain()->dim());
    for (const auto& [factor, A] : terms_) {
      Thyra::assign(term.ptr(), 0.0);
      Thyra::apply<Scalar>(*A, mode, X, term.ptr());
      Thyra::update(alpha * factor, *term, Y);
    }
  }

private:
  std::vector<std::pair<Scalar, InverseOp>> terms_;
};

}  // namespace

InverseOp inverse_sum(const std::vector<std::pair<Scalar, InverseOp>>& terms) {
  return Teuchos::rcp(new InverseSum(terms));
}

}  // namespace tunica::linear
