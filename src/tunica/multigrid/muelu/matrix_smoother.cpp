#include "tunica/multigrid/muelu/matrix_smoother.hpp"

namespace tunica::multigrid {

void MatrixSmoother::SetParameterList(const Teuchos::ParameterList& list) {
  SmootherPrototype::SetParameterList(list);
  check(GetParameterList());
}

void MatrixSmoother::DeclareInput(MueLu::Level& level) const { this->Input(level, "A"); }

void MatrixSmoother::Setup(MueLu::Level& level) {
  K_ = unwrapped(this->Get<Teuchos::RCP<XMatrix>>(level, "A"));
  set_up(level.GetLevelID(), K_);
  this->IsSetup(true);
}

void MatrixSmoother::Apply(XMultiVector& x, const XMultiVector& b, bool is_zero) const {
  if (is_zero)
    smooth_from_zero(*unwrapped(b), *unwrapped(x));
  else
    smooth(*unwrapped(b), *unwrapped(x));
}

void MatrixSmoother::smooth_from_zero(const ::tunica::MultiVector& b,
                                      ::tunica::MultiVector& x) const {
  x.putScalar(0.0);
  smooth(b, x);
}

}  // namespace tunica::multigrid
