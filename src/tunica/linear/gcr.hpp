#pragma once
#include <BelosCustomSolverFactory.hpp>
#include <BelosSolverManager.hpp>

#include "tunica/base/types.hpp"

namespace tunica::linear {

using BelosProblem = Belos::LinearProblem<Scalar, MultiVector, Operator>;

/// Generalised conjugate residuals as a Belos solver manager, "GCR":
///
///   z = P⁻¹ r,  q = A z,  q and z orthogonalised against the kept q_i (qᵀq_i = 0, |q| = 1),
///   x ← x + (qᵀr) z,  r ← r − (qᵀr) q
///
///   r  residual   z  search direction   q  its image   P  right preconditioner, may change
///
/// minimises |r| over the kept directions; after "Num Blocks" of them it begins anew. One right
/// side. Stagnation (q vanishes, or qᵀr no longer changes r) ends it as not converged.
///
/// Source: [EES] Eisenstat, Elman, Schultz 1983; the fluid's method in [LY1] section 5.4.
class Gcr : public Belos::SolverManager<Scalar, MultiVector, Operator> {
public:
  explicit Gcr(const Teuchos::RCP<Teuchos::ParameterList>& list);

  Teuchos::RCP<Belos::SolverManager<Scalar, MultiVector, Operator>> clone() const override;
  const BelosProblem& getProblem() const override { return *problem_; }
  Teuchos::RCP<const Teuchos::ParameterList> getValidParameters() const override;
  Teuchos::RCP<const Teuchos::ParameterList> getCurrentParameters() const override { return list_; }
  int getNumIters() const override { return iterations_; }
  bool isLOADetected() const override { return false; }
  Scalar achievedTol() const override { return relative_residual_; }
  void setProblem(const Teuchos::RCP<BelosProblem>& problem) override { problem_ = problem; }
  void setParameters(const Teuchos::RCP<Teuchos::ParameterList>& list) override;
  void reset(Belos::ResetType) override {}
  Belos::ReturnType solve() override;

private:
  Teuchos::RCP<Teuchos::ParameterList> list_;
  Teuchos::RCP<BelosProblem> problem_;
  int iterations_ = 0;
  double relative_residual_ = 1.0;
};

/// Makes "GCR" known to a Belos::SolverFactory.
class GcrFactory : public Belos::CustomSolverFactory<Scalar, MultiVector, Operator> {
public:
  Teuchos::RCP<Belos::SolverManager<Scalar, MultiVector, Operator>> getSolver(
      const std::string& name, const Teuchos::RCP<Teuchos::ParameterList>& list) override;
  int numSupportedSolvers() const override { return 1; }
  std::vector<std::string> supportedSolverNames() const override { return {"GCR"}; }
  bool isSupported(const std::string& name) const override { return name == "GCR"; }
};

}  // namespace tunica::linear
