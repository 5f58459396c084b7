#include "multigrid/mixed_smoother.hpp"

namespace tunica::multigrid {

void MixedSmoother::SetParameterList(const Teuchos::ParameterList& list) {
  SmootherPrototype::SetParameterList(list);
  check(GetParameterList());
}

void MixedSmoother::DeclareInput(MueLu::Level& level) const { this->Input(level, "A"); }

void MixedSmoother::Setup(MueLu::Level& level) {
  K_ = unwrapped(this->Get<Teuchos::RCP<XMatrix>>(level, "A"));
  coarsening_->check_mixed(level.GetLevelID(), *K_);
  set_up(*K_);
  this->IsSetup(true);
}

void MixedSmoother::Apply(XMultiVector& x, const XMultiVector& b, bool is_zero) const {
  if (is_zero) x.putScalar(0.0);
  smooth(*unwrapped(b), *unwrapped(x));
}

}  // namespace tunica::multigrid
