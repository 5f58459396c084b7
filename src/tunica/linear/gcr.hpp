#pragma once
#include <BelosSolverManager.hpp>
#include <string>

#include "tunica/base/types.hpp"

namespace tunica::linear {

using BelosProblem = Belos::LinearProblem<Scalar, MultiVector, Operator>;

/// Search directions Z of a matrix A and orthonormal vectors Q with A Z = Q R, R upper triangular.
/// They serve any right side, as long as A is the same.
class Directions {
public:
  int size() const { return static_cast<int>(z_.size()); }
  const MultiVector& last_image() const { return *q_.back(); }
  void clear() { keep_first(0); }
  /// Those that were added last.
  void keep_last(int number);
  void keep_first(int number);

  /// What `add` has found, with the sums over all ranks.
  struct Added {
    bool is_new = false;       ///< false: q depends on the others, and was not added
    double product = 0.0;      ///< qᵀ r of the q that was added
    double square_of_r = 0.0;  ///< |r|²
    double votes = 0.0;
  };
  /// Adds z and its image q, made orthonormal to the others: a pass of Gram and Schmidt, or two,
  /// each with one message. r: a residual that is orthogonal to the images that are there; vote: of
  /// this rank. Collective.
  Added add(const Teuchos::RCP<MultiVector>& z, const Teuchos::RCP<MultiVector>& q,
            const MultiVector& r, double vote);

  /// x ← x + Z R⁻¹ c, whose image is Q c. c may lack the last numbers, which are zero.
  void add_to(MultiVector& x, const std::vector<double>& c) const;
  /// x ← x + Z R⁻¹ Qᵀ r, r ← r − Q Qᵀ r: the least |r| that all directions permit. Collective.
  void minimise(MultiVector& r, MultiVector& x) const;

private:
  /// R⁻¹ c, where c may lack the last numbers.
  std::vector<double> solved(std::vector<double> c) const;

  std::vector<Teuchos::RCP<MultiVector>> z_, q_;
  std::vector<std::vector<double>> r_;  ///< the columns of R, down to the diagonal
};

/// Generalised conjugate residuals as a Belos solver manager, "GCR":
///
///   z = P⁻¹ r,  q = A z,  q orthogonalised against the kept q_i (qᵀq_i = 0, |q| = 1), A Z = Q R,
///   r ← r − (qᵀr) q,  and at the end x ← x + Z R⁻¹ Qᵀ(b − A x)
///
///   r  residual   z  search direction   q  its image   P  right preconditioner, may change
///
/// minimises |r| over the kept directions; after "Num Blocks" of them it begins anew. One right
/// side. An iteration is one reduction, with a poor P two. Where r stands still (q vanishes, or qᵀr
/// no longer changes r), z = P⁻¹ q of the last q goes on, as in flexible GMRES; a few such
/// iterations for nothing end it as not converged. So does what "Stagnation"
/// (solvers/stagnation.hpp) says of the residuals. Each iteration asks all ranks whether a signal
/// wants to end the program, and throws StopRequest then.
///
/// With "Recycled Directions", of which the caller knows that they are A's, it begins with those,
/// and leaves there the last "Num Recycled Blocks" of all: a direction in which P is poor is found
/// once, not with each right side. Solves of one or two iterations have none, and leave none.
///
/// Source: [EES] Eisenstat, Elman, Schultz 1983; passes of Gram and Schmidt: [DGKS] Daniel, Gragg,
/// Kaufman, Stewart 1976; the fluid's method in [LY1] section 5.4. Krylov spaces kept over a
/// sequence of systems: Parks, de Sturler, Mackey, Johnson, Maiti 2006.
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
  /// One iteration, along P⁻¹ of the source, whose qᵀ r it notes where it has a direction; false
  /// where it has gained nothing.
  bool iterate(const MultiVector& source, Directions& basis, MultiVector& r,
               std::vector<double>& products);
  void begin(const Directions& basis, MultiVector& r, MultiVector& x);

  Teuchos::RCP<Teuchos::ParameterList> list_;
  Teuchos::RCP<BelosProblem> problem_;
  int iterations_ = 0;
  double scale_ = 1.0;  ///< |b|
  double relative_residual_ = 1.0;
  bool has_stagnated_ = false;
};

}  // namespace tunica::linear
