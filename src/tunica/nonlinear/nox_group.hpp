#pragma once
#include <NOX_Abstract_Group.H>
#include <NOX_Thyra_Vector.H>

#include "tunica/nonlinear/newton.hpp"

namespace tunica::nonlinear {

/// The blocks of a NOX vector over the space, sharing its storage.
algebra::BlockVector blocks_of(const NOX::Abstract::Vector& v, const algebra::BlockSpacePtr& space);

/// Log of the groups of one solve, for its report.
struct SolveLog {
  std::vector<linear::SolveReport> linear;
  double step_length = 1.0;
  std::string refusal;  ///< why the last residual cannot serve; empty where it can
};

/// Whether a step takes a new Jacobian.
struct JacobianChoice {
  JacobianRule* rule;
  const NewtonReport* report;  ///< of the solve under way
  double absolute, relative;   ///< increments at which it stops

  bool wants_new() const;
};

/// F, its Jacobian and the Newton direction at a point. The linear solve stays in our hands:
/// its preconditioner outlives the group, and its outcome is logged.
class NoxGroup : public NOX::Abstract::Group {
public:
  NoxGroup(NonlinearProblem& problem, const JacobianChoice& choice, SolveLog& log,
           const NOX::Thyra::Vector& x);
  NoxGroup(const NoxGroup& other, NOX::CopyType type);

  NoxGroup& operator=(const NoxGroup& other);
  NOX::Abstract::Group& operator=(const NOX::Abstract::Group& source) override;
  void setX(const NOX::Abstract::Vector& y) override;
  void computeX(const NOX::Abstract::Group& group, const NOX::Abstract::Vector& d,
                double step) override;
  ReturnType computeF() override;
  ReturnType computeJacobian() override;
  ReturnType computeNewton(Teuchos::ParameterList& list) override;
  ReturnType applyJacobian(const NOX::Abstract::Vector& input,
                           NOX::Abstract::Vector& result) const override;

  bool isF() const override { return is_f_; }
  bool isJacobian() const override { return is_jacobian_; }
  bool isNewton() const override { return is_newton_; }
  const NOX::Abstract::Vector& getX() const override { return x_; }
  const NOX::Abstract::Vector& getF() const override { return f_; }
  double getNormF() const override { return norm_f_; }
  const NOX::Abstract::Vector& getGradient() const override { return newton_; }
  const NOX::Abstract::Vector& getNewton() const override { return newton_; }
  Teuchos::RCP<const NOX::Abstract::Vector> getXPtr() const override;
  Teuchos::RCP<const NOX::Abstract::Vector> getFPtr() const override;
  Teuchos::RCP<const NOX::Abstract::Vector> getGradientPtr() const override;
  Teuchos::RCP<const NOX::Abstract::Vector> getNewtonPtr() const override;
  Teuchos::RCP<NOX::Abstract::Group> clone(NOX::CopyType type) const override;
  void logLastLinearSolveStats(NOX::SolverStats&) const override {}

private:
  void forget();
  algebra::BlockVector blocks(const NOX::Abstract::Vector& v) const {
    return blocks_of(v, problem_->space());
  }

  NonlinearProblem* problem_;
  const JacobianChoice* choice_;
  SolveLog* log_;
  NOX::Thyra::Vector x_, f_, newton_;
  double norm_f_ = 0.0;
  bool is_f_ = false, is_jacobian_ = false, is_newton_ = false;
};

}  // namespace tunica::nonlinear
