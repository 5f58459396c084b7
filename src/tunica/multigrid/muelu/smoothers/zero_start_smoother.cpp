#include "tunica/multigrid/muelu/smoothers/zero_start_smoother.hpp"

namespace tunica::multigrid {

void ZeroStartSmoother::DeclareInput(MueLu::Level& level) const { smoother_->DeclareInput(level); }

void ZeroStartSmoother::Setup(MueLu::Level& level) {
  smoother_->Setup(level);
  this->IsSetup(true);
}

void ZeroStartSmoother::Apply(XMultiVector& x, const XMultiVector& b, bool is_zero) const {
  // MueLu leaves in x what it held, and block smoothers add to that.
  if (is_zero) x.putScalar(0.0);
  smoother_->Apply(x, b, is_zero);
}

Teuchos::RCP<ZeroStartSmoother::Prototype> ZeroStartSmoother::Copy() const {
  return Teuchos::rcp(new ZeroStartSmoother(smoother_->Copy()));
}

std::size_t ZeroStartSmoother::getNodeSmootherComplexity() const {
  return smoother_->getNodeSmootherComplexity();
}

}  // namespace tunica::multigrid
