#pragma once
#include <BelosSolverManager.hpp>
#include <string>

#include "tunica/base/types.hpp"

namespace tunica::linear {

using BelosProblem = Belos::LinearProblem<Scalar, MultiVector, Operator>;

/// Search directions Z of a matrix A and their orthonormal images Q = A Z. They serve any right
/// side, as long as A is the same.
class Directions {
public:
  int size() const { return static_cast<int>(z_.size()); }
  const MultiVector& last_image() const { return *q_.back(); }
  void clear() { keep_last(0); }
  /// Those that were added last.
  void keep_last(int number);
  void keep_first(int number);

  /// Adds z and its image q, made orthonormal to the others: two passes of Gram and Schmidt, each
  /// with one message. False where q depends on the others already. Collective.
  bool add(const Teuchos::RCP<MultiVector>& z, const Teuchos::RCP<MultiVector>& q);

  /// x ← x + Z Qᵀ r, r ← r − Q Qᵀ r: the least |r| that all directions permit. Collective.
  void minimise(MultiVector& r, MultiVector& x) const { minimise_from(0, r, x); }
  /// Minimises along the direction added last, after the others. The message takes a vote of each
  /// rank along; returns their sum.
  double minimise_by_last(MultiVector& r, MultiVector& x, double vote) const {
    return minimise_from(size() - 1, r, x, vote);
  }

private:
  double minimise_from(int first, MultiVector& r, MultiVector& x, double vote = 0.0) const;

  std::vector<Teuchos::RCP<MultiVector>> z_, q_;
};

/// Generalised conjugate residuals as a Belos solver manager, "GCR":
///
///   z = P⁻¹ r,  q = A z,  q and z orthogonalised against the kept q_i (qᵀq_i = 0, |q| = 1),
///   x ← x + (qᵀr) z,  r ← r − (qᵀr) q
///
///   r  residual   z  search direction   q  its image   P  right preconditioner, may change
///
/// minimises |r| over the kept directions; after "Num Blocks" of them it begins anew. One right
/// side. Where r stands still (q vanishes, or qᵀr no longer changes r), z = P⁻¹ q of the last q
/// goes on, as in flexible GMRES; a few such iterations for nothing end it as not converged. So
/// does what "Stagnation" (solvers/stagnation.hpp) says of the residuals. Each iteration asks all
/// ranks whether a signal wants to end the program, and throws StopRequest then.
///
/// With "Recycled Directions", of which the caller knows that they are A's, it begins with those,
/// and leaves there the last "Num Recycled Blocks" of all: a direction in which P is poor is found
/// once, not with each right side. Solves of one or two iterations have none, and leave none.
///
/// Source: [EES] Eisenstat, Elman, Schultz 1983; the fluid's method in [LY1] section 5.4. Krylov
/// spaces kept over a sequence of systems: Parks, de Sturler, Mackey, Johnson, Maiti 2006.
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
  /// It was ended by "Stagnation".
  bool has_stagnated() const { return has_stagnated_; }
  void setProblem(const Teuchos::RCP<BelosProblem>& problem) override { problem_ = problem; }
  void setParameters(const Teuchos::RCP<Teuchos::ParameterList>& list) override;
  void reset(Belos::ResetType) override {}
  Belos::ReturnType solve() override;

private:
  std::string how_far() const;
  /// One iteration, along P⁻¹ of the source; false where it has gained nothing.
  bool iterate(const MultiVector& source, Directions& basis, MultiVector& r, MultiVector& x,
               double scale);

  Teuchos::RCP<Teuchos::ParameterList> list_;
  Teuchos::RCP<BelosProblem> problem_;
  int iterations_ = 0;
  double relative_residual_ = 1.0;
  bool has_stagnated_ = false;
};

}  // namespace tunica::linear
