#pragma once
#include <string>

#include "tunica/base/types.hpp"
#include "tunica/linear/gcr.hpp"
#include "tunica/linear/solvers/stagnation.hpp"

namespace tunica::linear {

struct KrylovOptions {
  std::string method;  ///< name of a Belos solver manager, or GCR
  int max_iterations;
  int restart;  ///< basis vectors kept, of methods that keep a basis; 0 for others
  /// For GCR: directions from solves with the same matrix, which it begins with and adds to.
  Teuchos::RCP<Directions> recycled = Teuchos::null;
  int most_recycled = 0;
  Teuchos::RCP<StagnationRule> stagnation = Teuchos::null;  ///< of GCR; null: none
};

struct KrylovResult {
  int iterations;
  double recurrence_residual;  ///< relative
  bool has_stagnated = false;  ///< given up by the rule
};

/// Solves A X = B from the X given by a Belos method with right preconditioning (null: none).
/// The residual is measured against |B|. Breakdown shows as a residual that is not small. Throws
/// StopRequest on all ranks where a signal wants to end the program. Collective.
KrylovResult solve_krylov(const KrylovOptions& options, const Teuchos::RCP<const Operator>& A,
                          const Teuchos::RCP<const Operator>& preconditioner, const MultiVector& B,
                          MultiVector& X, double tolerance);

}  // namespace tunica::linear
