#include "tunica/multigrid/muelu/smoothers/matrix_smoother.hpp"

#include <algorithm>
#include <stdexcept>

#include "tunica/algebra/columns.hpp"
#include "tunica/params/nearest.hpp"

namespace tunica::multigrid {

void MatrixSmoother::SetParameterList(const Teuchos::ParameterList& list) {
  SmootherPrototype::SetParameterList(list);
  check(GetParameterList());
}

void MatrixSmoother::DeclareInput(MueLu::Level& level) const { this->Input(level, "A"); }

void MatrixSmoother::Setup(MueLu::Level& level) {
  const auto A = this->Get<Teuchos::RCP<XMatrix>>(level, "A");
  K_ = unwrapped(A);
  set_up(level.GetLevelID(), K_);
  if (auto* const matrix = dynamic_cast<LevelMatrix*>(A.get())) offer_residuals(*matrix);
  this->IsSetup(true);
}

// From x = 0 the first residual is b: a smoother may save the product with K.
void MatrixSmoother::Apply(XMultiVector& x, const XMultiVector& b, bool is_zero) const {
  const auto from = unwrapped(b);
  const auto to = unwrapped(x);
  algebra::check_columns("a smoother", *from, *to);
  if (is_zero)
    smooth_from_zero(*from, *to);
  else
    smooth(*from, *to);
}

void MatrixSmoother::smooth_from_zero(const ::tunica::MultiVector& b,
                                      ::tunica::MultiVector& x) const {
  x.putScalar(0.0);
  smooth(b, x);
}

std::string validated_choice(const std::string& smoother, const Teuchos::ParameterList& list,
                             const std::string& key, const std::vector<std::string>& known) {
  const auto& value = list.get<std::string>(key);
  if (std::find(known.begin(), known.end(), value) == known.end())
    throw std::invalid_argument(smoother + ": \"" + key + "\" is \"" + value +
                                "\", expected one of " + params::quoted(known) + ".");
  return value;
}

}  // namespace tunica::multigrid
