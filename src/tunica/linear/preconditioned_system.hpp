#pragma once
#include <memory>

#include "tunica/algebra/block_matrix.hpp"
#include "tunica/multigrid/muelu/cycle.hpp"

namespace tunica::linear {

/// A block system in the form of vector that its preconditioner works on.
class PreconditionedSystem {
public:
  virtual ~PreconditionedSystem() = default;

  virtual Teuchos::RCP<const Map> map() const = 0;
  /// The blocks, without what K has of low rank.
  virtual Teuchos::RCP<const Operator> matrix() const = 0;
  /// Preconditioner of matrix(). Null: none.
  virtual Teuchos::RCP<const Operator> preconditioner() const = 0;

  /// Takes over the present values of the block operator.
  virtual void refresh_matrix() = 0;
  /// Sets the preconditioner up for them.
  virtual void refresh_preconditioner() = 0;

  /// Estimated bytes of the factors that refresh_preconditioner() will make, for a direct solver;
  /// otherwise 0. Collective.
  virtual double expected_bytes() const { return 0.0; }

  /// Levels of the multigrid hierarchy as it was set up last, none by default. Collective.
  virtual multigrid::Levels levels() const { return {}; }

  /// Iterations that a solve has taken, and the part of the residual that it has left. True where
  /// the next set-up makes a better preconditioner, which a solve that has failed may try at once.
  virtual bool note(int iterations, double reduction) {
    static_cast<void>(iterations);
    static_cast<void>(reduction);
    return false;
  }

  /// Whether note() may become true: a solve that is slow need not be gone through with.
  virtual bool may_improve() const { return false; }

  /// What set-ups have taught the preconditioner, as LinearSolver has it.
  virtual std::vector<double> save() const { return {}; }
  virtual void restore(const std::vector<double>& numbers) { static_cast<void>(numbers); }

  virtual void gather(const algebra::BlockVector& x, MultiVector& all) const = 0;
  virtual void scatter(const MultiVector& all, algebra::BlockVector& x) const = 0;
};

}  // namespace tunica::linear
