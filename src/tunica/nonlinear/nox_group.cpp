#include "tunica/nonlinear/nox_group.hpp"

#include <Thyra_DefaultProductVector.hpp>
#include <Thyra_TpetraThyraWrappers.hpp>
#include <algorithm>
#include <cmath>

#include "tunica/base/fault_point.hpp"
#include "tunica/base/stop_signals.hpp"
#include "tunica/io/progress.hpp"

namespace tunica::nonlinear {

algebra::BlockVector blocks_of(const NOX::Abstract::Vector& v,
                               const algebra::BlockSpacePtr& space) {
  using Extract = Thyra::TpetraOperatorVectorExtraction<Scalar, LocalOrdinal, GlobalOrdinal, Node>;
  // NOX hands out const vectors whose storage its own groups may write.
  auto& vector = const_cast<NOX::Thyra::Vector&>(dynamic_cast<const NOX::Thyra::Vector&>(v));
  const auto product =
      Teuchos::rcp_dynamic_cast<Thyra::ProductVectorBase<double>>(vector.getThyraRCPVector(), true);
  std::vector<Teuchos::RCP<Vector>> blocks;
  for (int b = 0; b < space->n_blocks(); ++b)
    blocks.push_back(Extract::getTpetraVector(product->getNonconstVectorBlock(b)));
  return {space, blocks};
}

bool JacobianChoice::wants_new() const {
  const double first = report->steps.empty() ? 0.0 : report->steps.front().increment;
  return rule->wants_new(report->steps, std::max(absolute, relative * first));
}

NoxGroup::NoxGroup(NonlinearProblem& problem, const JacobianChoice& choice, SolveLog& log,
                   const NOX::Thyra::Vector& x)
    : problem_(&problem), choice_(&choice), log_(&log), x_(x, NOX::DeepCopy), f_(x, NOX::ShapeCopy),
      newton_(x, NOX::ShapeCopy) {}

NoxGroup::NoxGroup(const NoxGroup& other, NOX::CopyType type)
    : problem_(other.problem_), choice_(other.choice_), log_(other.log_), x_(other.x_, type),
      f_(other.f_, type), newton_(other.newton_, type) {
  if (type == NOX::DeepCopy) *this = other;
}

NOX::Abstract::Group& NoxGroup::operator=(const NOX::Abstract::Group& source) {
  return *this = dynamic_cast<const NoxGroup&>(source);
}

NoxGroup& NoxGroup::operator=(const NoxGroup& other) {
  if (this == &other) return *this;
  x_ = other.x_;
  f_ = other.f_;
  newton_ = other.newton_;
  norm_f_ = other.norm_f_;
  is_f_ = other.is_f_;
  is_jacobian_ = other.is_jacobian_;
  is_newton_ = other.is_newton_;
  return *this;
}

void NoxGroup::forget() { is_f_ = is_jacobian_ = is_newton_ = false; }

void NoxGroup::setX(const NOX::Abstract::Vector& y) {
  x_ = y;
  forget();
}

void NoxGroup::computeX(const NOX::Abstract::Group& group, const NOX::Abstract::Vector& d,
                        double step) {
  x_.update(1.0, group.getX(), step, d, 0.0);  // x ← x + λ d
  log_->step_length = step;
  forget();
}

NOX::Abstract::Group::ReturnType NoxGroup::computeF() {
  if (is_f_) return Ok;
  algebra::BlockVector F = blocks(f_);
  const Outcome outcome = problem_->residual(blocks(x_), F);
  log_->refusal = outcome.reason();
  if (outcome.is_failure()) return Failed;
  norm_f_ = f_.norm(NOX::Abstract::Vector::TwoNorm);
  is_f_ = std::isfinite(norm_f_);
  if (!is_f_) log_->refusal = "the residual is not a number";
  return is_f_ ? Ok : Failed;
}

NOX::Abstract::Group::ReturnType NoxGroup::computeJacobian() {
  fault_point("jacobian");
  if (!is_jacobian_ && choice_->wants_new()) {
    problem_->jacobian(blocks(x_));
    choice_->rule->renewed();
  } else if (!is_jacobian_) {
    choice_->rule->kept();
  }
  is_jacobian_ = true;
  return Ok;
}

NOX::Abstract::Group::ReturnType NoxGroup::computeNewton(Teuchos::ParameterList& list) {
  if (is_newton_) return Ok;
  const io::ProgressScope scope("Newton step " + std::to_string(choice_->report->steps.size() + 1));
  stop_if_urgent(*problem_->space()->comm());
  // d = −J⁻¹ F to the tolerance of this step
  algebra::BlockVector direction = blocks(newton_);
  log_->linear.push_back(
      problem_->linear_solver().solve(blocks(f_), direction, list.get<double>("Tolerance")));
  problem_->hold_prescribed(direction);
  newton_.scale(-1.0);
  is_newton_ = true;
  return log_->linear.back().is_converged ? Ok : NotConverged;
}

NOX::Abstract::Group::ReturnType NoxGroup::applyJacobian(const NOX::Abstract::Vector& input,
                                                         NOX::Abstract::Vector& result) const {
  if (!is_jacobian_) return BadDependency;
  algebra::BlockVector y = blocks(result);
  problem_->apply_jacobian(blocks(input), y);
  return Ok;
}

Teuchos::RCP<const NOX::Abstract::Vector> NoxGroup::getXPtr() const {
  return Teuchos::rcpFromRef(x_);
}
Teuchos::RCP<const NOX::Abstract::Vector> NoxGroup::getFPtr() const {
  return Teuchos::rcpFromRef(f_);
}
Teuchos::RCP<const NOX::Abstract::Vector> NoxGroup::getGradientPtr() const {
  return Teuchos::rcpFromRef(newton_);
}
Teuchos::RCP<const NOX::Abstract::Vector> NoxGroup::getNewtonPtr() const {
  return Teuchos::rcpFromRef(newton_);
}

Teuchos::RCP<NOX::Abstract::Group> NoxGroup::clone(NOX::CopyType type) const {
  return Teuchos::rcp(new NoxGroup(*this, type));
}

}  // namespace tunica::nonlinear
